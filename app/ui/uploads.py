"""Uploads in progress: what their pages declared, and what has come so far. viser holds them in memory."""

from __future__ import annotations

import re
from dataclasses import dataclass, field

from app.ui.guard import Guard
from app.ui.inbound import FileTransferPart, FileTransferStartUpload

MAX_FILE_NAME = 120
MIN_PART_BYTES = 64 * 1024
"""A browser sends parts of 512 KiB."""


@dataclass
class _Upload:
    page: int
    begun: FileTransferStartUpload
    received: int = 0
    parts: set[int] = field(default_factory=set)


class UploadLedger:
    """Keeps every page's uploads within the guard's limits and within what was declared for them.

    Pages are numbers, sizes are in bytes.
    """

    def __init__(self, guard: Guard) -> None:
        self._guard = guard
        self._uploads: dict[str, _Upload] = {}

    def begin(self, page: int, upload: FileTransferStartUpload) -> bool:
        """Whether a page may begin this upload; if so, its size is reserved."""
        size, part_count = upload.size_bytes, upload.part_count
        mine = [other.begun.size_bytes for other in self._uploads.values() if other.page == page]
        everybody = sum(other.begun.size_bytes for other in self._uploads.values())
        fits = (
            upload.transfer_uuid not in self._uploads
            and (part_count > 0) == (size > 0)
            and part_count <= 1 + size // MIN_PART_BYTES
            and len(mine) < self._guard.max_uploads
            and size + sum(mine) <= self._guard.max_upload_bytes
            and size + everybody <= self._guard.max_upload_bytes_in_all
        )
        if fits and size:
            self._uploads[upload.transfer_uuid] = _Upload(page, upload)
        return fits

    def take(self, page: int, part: FileTransferPart) -> bool:
        """Whether this part belongs to what the page declared; the last part ends the upload.

        viser gives a file to whatever input its last part names, so every part has to name the same one.
        """
        upload = self._uploads.get(part.transfer_uuid)
        if upload is None or upload.page != page or part.part_index in upload.parts:
            return False
        begun = upload.begun
        if part.source_component_uuid != begun.source_component_uuid or part.part_index >= begun.part_count:
            return False
        is_last = len(upload.parts) + 1 == begun.part_count
        received = upload.received + len(part.content)
        if received > begun.size_bytes or (is_last and received < begun.size_bytes):
            return False
        upload.received = received
        upload.parts.add(part.part_index)
        if is_last:
            del self._uploads[part.transfer_uuid]
        return True

    def forget(self, page: int) -> None:
        """A page has gone, and its unfinished uploads with it."""
        self._uploads = {name: upload for name, upload in self._uploads.items() if upload.page != page}


def base_name(path: str) -> str:
    """A file name without folders, control characters and leading dots."""
    name = re.split(r"[/\\]", path)[-1]
    printable = "".join(character for character in name if character.isprintable())
    return printable.strip().lstrip(".")[-MAX_FILE_NAME:] or "upload"
