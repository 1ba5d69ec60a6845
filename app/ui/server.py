"""The page's server: one room a browser, and what all rooms share."""

from __future__ import annotations

import functools
import gc
import multiprocessing
import os
import signal
import sys
import threading
import webbrowser
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

import viser

from app.classroom.opening import open_classroom
from app.recent import Recent
from app.resources import lessons_dir
from app.robots import ROBOTS, build_robot
from app.ui.classroom.hall import Hall
from app.ui.classroom.invitation import Invitation
from app.ui.compute import make_pools
from app.ui.drawing.warm_up import warm_up_server, warm_up_worker
from app.ui.guard import Guard, is_loopback
from app.ui.hardware.workshop import Workshop, choose_pin
from app.ui.jobs import warm_up
from app.ui.lab.jobs import warm_up as warm_up_control
from app.ui.lessons.library import Library
from app.ui.options import ServeOptions
from app.ui.room import Room
from app.ui.shape_cache import ShapeCache
from app.ui.stage import light_the_room
from app.ui.state import Memory, ViewOptions
from app.ui.viser_adapter import browser_id, start_server, stop_server
from app.ui.workspace_view import CACHE_SIZE, WorkspaceCache

if TYPE_CHECKING:
    from app.classroom.lessons.course import Course

REMEMBERED = 200
"""Browsers that find their robot again after a reload; the longest absent are forgotten first. A picture takes 1 MB."""

WARM_UP_AFTER_S = 1.0


class Lab:
    """A running server."""

    def __init__(self, options: ServeOptions) -> None:
        self._options = options
        self._pools = make_pools()
        self._shapes = ShapeCache()
        self._shapes.learn(build_robot(options.robot, {}))
        self._spaces = WorkspaceCache(CACHE_SIZE)
        self._memories: Recent[str, Memory] = Recent(REMEMBERED)
        self._fresh = Memory(options.robot, view=ViewOptions(shadows=options.shadows))
        local_only = is_loopback(options.host)
        self.pin = choose_pin(
            options.pin, serial=options.serial is not None, local_only=local_only, in_class=options.classroom
        )
        self._loading = threading.Lock()
        self._course: Course | None = None
        self.classroom = open_classroom(
            options.data,
            in_class=options.classroom,
            pin=self.pin,
            name=options.class_name,
            outline=lambda: self._library.outline(),
        )
        self._library = Library(lambda: self.course, self._pools.quick)
        self.workshop = Workshop(self.classroom, local_only=local_only)
        self.hall = Hall(self.classroom, self.pin, self._shapes, self._invite) if options.classroom else None
        self.rooms: dict[int, Room] = {}
        self.server = start_server(options.host, options.port, Guard(allowed_hosts=options.allowed_hosts))
        light_the_room(self.server)
        self.server.gui.set_panel_label("Delta Lab")
        self.server.on_client_connect(self._welcome)
        self.server.on_client_disconnect(self._farewell)

    @property
    def url(self) -> str:
        host = "localhost" if self._options.host in ("127.0.0.1", "0.0.0.0", "::1", "::") else self._options.host
        return f"http://{host}:{self.server.get_port()}"

    @property
    def course(self) -> Course:
        """The lessons; read when somebody wants them first."""
        with self._loading:  # the warm-up and the first page may both want it first
            if self._course is None:
                from app.classroom.lessons.course import Course

                self._course = Course(lessons_dir())
            return self._course

    def _invite(self) -> Invitation:
        return Invitation(self._options.host, self.server.get_port(), self.classroom.code)

    def close(self) -> None:
        """Stop at once; what the workers compute is dropped."""
        stop_server(self.server)
        self.workshop.close()
        self.classroom.close()
        for process in multiprocessing.active_children():
            process.kill()
        self._pools.shutdown()

    def warm_up(self, stop: threading.Event) -> None:
        """Start the workers and load what tabs need while nobody waits for it, until `stop`."""
        try:
            for step in self._warm_up_steps():
                if stop.is_set():
                    return
                step()
        except RuntimeError:
            if not stop.is_set():  # the workers were closed in the middle of a step
                raise

    def _warm_up_steps(self) -> Iterator[Callable[[], object]]:
        """The other robots' shapes come last; then what the start has made stays, and the garbage collector need not
        walk through it during drags."""
        yield lambda: self._pools.quick.submit(warm_up_control)
        for pool in self._pools:
            yield functools.partial(pool.submit, warm_up_worker)
        yield warm_up_server
        yield self.workshop.warm_up
        yield lambda: self.course
        yield lambda: self._pools.slow.submit(warm_up)
        for name in ROBOTS:
            yield lambda name=name: self._shapes.learn(build_robot(name, {}))
        yield gc.collect
        yield gc.freeze

    async def _welcome(self, client: viser.ClientHandle) -> None:
        memory = self._memory_of(browser_id(client))
        caches = self._shapes, self._spaces
        room = Room(client, memory, self._pools, *caches, self.workshop, self.hall, self._library)
        self.rooms[client.client_id] = room
        await room.furnish()

    def _memory_of(self, browser: str) -> Memory:
        """What this browser did last. After a quick reload its old page may not have said farewell yet."""
        for room in reversed(self.rooms.values()):
            if room.browser == browser:
                return room.session.memory
        return self._memories.get(browser) or self._fresh

    async def _farewell(self, client: viser.ClientHandle) -> None:
        room = self.rooms.pop(client.client_id, None)
        if room is None:
            return
        room.close()
        self._memories.put(room.browser, room.session.memory)


def serve(options: ServeOptions) -> None:
    """Serve until interrupted."""
    stop = threading.Event()
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda *_: stop.set())
    lab = Lab(options)
    print(f"Delta Lab is running at {lab.url} (Ctrl-C stops it)", flush=True)
    if lab.classroom.notice:
        print(lab.classroom.notice, flush=True)
    if lab.hall is not None:
        print(lab.hall.invitation.text(lab.pin, sys.stdout.encoding), flush=True)
    elif lab.pin:
        print(f"The instructor's PIN is {lab.pin}", flush=True)
    if options.serial is not None:
        lab.workshop.connect_at_start(options.serial, lambda sentence: print(sentence, flush=True))
    if options.open_browser:
        webbrowser.open(lab.url if lab.hall is None else lab.hall.instructor_url)
    try:
        if not stop.wait(WARM_UP_AFTER_S):
            # on another thread: Ctrl-C is heeded at once
            threading.Thread(target=lab.warm_up, args=(stop,), name="warm-up", daemon=True).start()
            stop.wait()
    finally:
        lab.close()
    # A pool may still be writing to a killed worker, and Python would wait for that for ever.
    sys.stdout.flush()
    os._exit(0)
