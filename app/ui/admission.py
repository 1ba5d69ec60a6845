"""Which of a page's messages are let through: well-formed ones that fit what they are about."""

from __future__ import annotations

import logging
from typing import Any, Protocol

import msgspec

from app.ui import inbound
from app.ui.uploads import UploadLedger, base_name

_log = logging.getLogger(__name__)


class Page(Protocol):
    """What there is to know about the page that speaks."""

    @property
    def number(self) -> int: ...

    def element(self, uuid: str) -> Any | None:
        """The input with this identity, if the page sees it."""
        ...

    def takes_files(self, uuid: str) -> bool:
        """Whether that input is an upload button."""
        ...

    def has_container(self, uuid: str) -> bool:
        """Whether the page sees a form or folder with this identity."""
        ...

    def decline_upload(self, upload: inbound.FileTransferStartUpload) -> None:
        """Tell the page that its upload is not taken."""
        ...


class Admission:
    """Looks at everything one page sends."""

    def __init__(self, page: Page, uploads: UploadLedger) -> None:
        self._page = page
        self._uploads = uploads

    def admit(self, frame: bytes) -> inbound.Inbound | None:
        """The message in a frame as it may be acted upon; None if it is refused.

        Raises `inbound.Garbled` if it is no message at all.
        """
        message = inbound.decode(frame)
        admitted = None if message is None else self._check(message)
        if admitted is None:
            _log.debug("page %d: refused %r", self._page.number, frame[:200])
        return admitted

    def _check(self, message: inbound.Inbound) -> inbound.Inbound | None:
        match message:
            case inbound.GuiUpdateMessage():
                return self._fit(message)
            case inbound.GuiButtonHoldMessage():
                fits = self._enabled(message.uuid) is not None
            case inbound.GuiFormSubmitMessage() | inbound.GuiFormDirtyMessage():
                fits = self._page.has_container(message.uuid)
            case inbound.FileTransferStartUpload():
                return self._begin(message)
            case inbound.FileTransferPart():
                fits = self._uploads.take(self._page.number, message)
            case _:
                fits = True
        return message if fits else None

    def _enabled(self, uuid: str) -> Any | None:
        element = self._page.element(uuid)
        return None if element is None or element.disabled else element

    def _fit(self, message: inbound.GuiUpdateMessage) -> inbound.GuiUpdateMessage | None:
        element = self._enabled(message.uuid)
        value = None if element is None else inbound.fit(message.updates.value, element)
        return None if value is None else inbound.GuiUpdateMessage(message.uuid, inbound.NewValue(value))

    def _begin(self, upload: inbound.FileTransferStartUpload) -> inbound.FileTransferStartUpload | None:
        button = upload.source_component_uuid
        if self._enabled(button) is None or not self._page.takes_files(button):
            return None
        if not self._uploads.begin(self._page.number, upload):
            self._page.decline_upload(upload)
            return None
        return msgspec.structs.replace(upload, filename=base_name(upload.filename))
