"""What people may ask of the robot, and who may ask it.

Orders return nothing, a value, or a `Future` of what the board will answer; they raise `LinkError` where they are
refused at once.
"""

from __future__ import annotations

from collections.abc import Mapping
from concurrent.futures import Future

from app.link.conversation import Refused, Script
from app.link.errors import LinkError
from app.link.handshake import limit_ids, shake_hands
from app.link.lease import Person
from app.link.mover import command
from app.link.pilot import Pilot
from app.link.programs import Jog, Program
from app.link.protocol.codes import Command, DriveKind, Refusal
from app.link.protocol.messages import Order, Test
from app.link.protocol.settings import GEOMETRY_ID, setting_id
from app.link.settings_exchange import apply, check_values
from app.link.trial import Trial
from app.link.twin.recorder import Recorder
from app.link.twin.recording import Recording
from app.robots import Robot

SLOWEST, FASTEST = 0.05, 1.0
"""Range of the override."""


class Orders:
    """`now` is the pilot's time, in s."""

    def __init__(self, pilot: Pilot) -> None:
        self._pilot = pilot

    def connect(self, port: str, robot: str | None, now: float) -> Future[None]:
        self._pilot.halt_all(now, "Another connection was asked for.")
        self._pilot.telemetry = None
        return self._pilot.connection.connect(port, robot, now)

    def disconnect(self, now: float) -> None:
        self._pilot.halt_all(now, "The connection was ended.")
        self._pilot.telemetry = None
        self._pilot.connection.disconnect()

    def request(self, person: Person, now: float) -> None:
        self._pilot.lease.request(person, now)
        self._pilot.watch_holder(now)

    def release(self, person: Person, now: float) -> None:
        self._pilot.lease.release(person, now)
        self._pilot.watch_holder(now)

    def take_over(self, person: Person, now: float) -> None:
        self._pilot.lease.take_over(person, now)
        self._pilot.watch_holder(now)

    def hand_to(self, giver: Person, person: Person, now: float) -> None:
        self._pilot.lease.hand_to(giver, person, now)
        self._pilot.watch_holder(now)

    def alive(self, person: Person, now: float) -> None:
        self._pilot.lease.alive(person, now)

    def stop(self, person: Person, now: float) -> Future[None]:
        """Anyone. Written before anything else, which it ends."""
        return self._end_all(Command.STOP, f"{person.name} pressed Stop.", now)

    def power_off(self, person: Person, now: float) -> Future[None]:
        self._allow(person, instructor=True)
        return self._end_all(Command.OFF, f"{person.name} switched the motors off.", now)

    def clear(self, person: Person, now: float) -> Future[None]:
        return self._command(person, Command.CLEAR, now)

    def enable(self, person: Person, now: float) -> Future[None]:
        return self._command(person, Command.ENABLE, now)

    def home(self, person: Person, now: float) -> Future[None]:
        return self._command(person, Command.HOME, now)

    def resume(self, person: Person, now: float) -> Future[None]:
        """A paused program goes on; without one, a board that holds is ready again."""
        self._allow(person, instructor=True)
        going_on = self._pilot.helm.resume(now)
        return self._command(person, Command.FOLLOW, now) if going_on is None else going_on

    def jog(self, person: Person, jog: Jog, now: float) -> Future[None] | None:
        self._allow(person)
        return self._pilot.helm.jog(jog, now)

    def jog_release(self, person: Person, now: float) -> None:
        """From anybody but the holder it means nothing."""
        if self._pilot.lease.holds(person):
            self._pilot.helm.jog_release(now)

    def step(self, person: Person, jog: Jog, size: float, now: float) -> Future[None]:
        self._allow(person)
        return self._pilot.helm.step(jog, size, now)

    def mirror(self, person: Person, pose: tuple[float, ...], now: float) -> Future[None] | None:
        self._allow(person)
        return self._pilot.helm.mirror(pose, now)

    def mirror_end(self, person: Person, now: float) -> None:
        """From anybody but the holder it means nothing."""
        if self._pilot.lease.holds(person):
            self._pilot.helm.mirror_end(now)

    def run(self, person: Person, program: Program, now: float) -> Future[None]:
        self._allow(person)
        return self._pilot.helm.run(program, now)

    def pause(self, person: Person, now: float) -> None:
        self._allow(person, instructor=True)
        self._pilot.helm.pause(now)

    def cancel(self, person: Person, now: float) -> None:
        """End whatever moves the robot, for good."""
        self._allow(person, instructor=True)
        self._pilot.halt_all(now, f"{person.name} ended the motion.")

    def set_override(self, person: Person, share: float, now: float) -> None:
        self._allow(person, instructor=True)
        if not SLOWEST <= share <= FASTEST:
            raise LinkError(f"The speed is {100 * SLOWEST:.0f} to {100 * FASTEST:.0f} %; choose a value in between.")
        self._pilot.mover.override = share

    def apply_settings(self, person: Person, values: Mapping[int, float], save: bool, now: float) -> Future[None]:
        """Each value is set, read back and compared; `save` makes the board remember them."""
        self._allow(person)
        connection = self._pilot.connection
        if connection.identity is None:
            raise LinkError("No robot is connected; choose a port and connect.")
        check_values(values, connection.settings, connection.identity.robot)
        return self._pilot.conversation.ask(self._apply(values, save), now)

    def restore_defaults(self, person: Person, now: float) -> Future[None]:
        """As built; limits and geometry may be others then, so the board is got to know again."""
        self._allow(person)
        self._pilot.require_robot()
        return self._pilot.conversation.ask(self._restore(), now)

    def read_settings(self, now: float) -> None:
        """All of them again, in the background."""
        self._pilot.require_robot()
        self._pilot.forget_settings()

    def test(self, person: Person, test: Test, now: float) -> Future[Recording]:
        """A TEST on the board; its answer is a recording with the samples."""
        self._allow(person)
        pilot = self._pilot
        if pilot.connection.identity is None or pilot.connection.identity.drive is not DriveKind.DC:
            raise LinkError("Only DC drives can be tested; servos and steppers have no sensor to learn from.")
        if pilot.mover.activity != "idle" or pilot.trial is not None:
            raise Refused(Refusal.BUSY)
        if not pilot.is_homed():
            raise Refused(Refusal.NOT_HOMED)
        pilot.trial = Trial(test, self._recorder(f"Test of joint {test.joint + 1}"))
        pilot.trial.answer.add_done_callback(lambda _: setattr(pilot, "trial", None))
        answer = pilot.trial.answer
        pilot.conversation.ask(pilot.trial.script(), now).add_done_callback(pilot.trial.begun)
        return answer

    def start_recording(self, now: float) -> None:
        self._pilot.recorder = self._recorder("Recording")

    def stop_recording(self, now: float) -> Recording:
        recorder, self._pilot.recorder = self._pilot.recorder, None
        if recorder is None:
            raise LinkError("Nothing is being recorded; start a recording first.")
        return recorder.recording()

    def _recorder(self, title: str) -> Recorder:
        robot = self._pilot.require_robot()
        supply = self._pilot.connection.settings.get(setting_id("supply"), 12.0)
        return Recorder(robot.name, title, supply, changed_dimensions(robot))

    def _allow(self, person: Person, *, instructor: bool = False) -> None:
        """The holder; or an instructor too."""
        lease = self._pilot.lease
        if lease.holds(person) or (instructor and person.instructor):
            return
        if lease.holder is None:
            raise LinkError("Nobody has the robot; ask for it first.")
        raise LinkError(f"{lease.holder.name} has the robot; ask for it and wait for your turn.")

    def _command(self, person: Person, order: Command, now: float) -> Future[None]:
        self._allow(person, instructor=True)
        self._pilot.require_robot()
        if self._pilot.mover.activity != "idle":
            raise LinkError("The robot is moving or paused; end that first.")
        return self._pilot.conversation.ask(command(order), now)

    def _end_all(self, order: Command, sentence: str, now: float) -> Future[None]:
        pilot = self._pilot
        if not pilot.connection.is_open:
            raise LinkError("No robot is connected, so nothing was sent; use the emergency stop at the robot.")
        pilot.drop_everything(now, sentence)
        pilot.say(sentence)
        answer = pilot.conversation.ask(command(order), now)
        answer.add_done_callback(self._check_arrival)
        return answer

    def _check_arrival(self, answer: Future[None]) -> None:
        if answer.exception() is not None and self._pilot.connection.ready:
            self._pilot.say("The board did not confirm; use the emergency stop at the robot.")

    def _apply(self, values: Mapping[int, float], save: bool) -> Script[None]:
        """Where limits or geometry change, the board is got to know again."""
        connection = self._pilot.connection
        yield from apply(values, save, connection.settings.__setitem__)
        identity = connection.identity
        if identity is None or not any(id >= GEOMETRY_ID or id in limit_ids(identity.joints) for id in values):
            return
        yield from self._meet_again()

    def _restore(self) -> Script[None]:
        yield Order(Command.DEFAULTS)
        self._pilot.forget_settings()
        yield from self._meet_again()

    def _meet_again(self) -> Script[None]:
        connection = self._pilot.connection
        found = yield from shake_hands(None)
        connection.identity, connection.robot = found.identity, found.robot
        connection.settings.update(found.settings)


def changed_dimensions(robot: Robot) -> dict[str, float]:
    """Those that differ from the robot's default, m and rad."""
    default = type(robot.geometry)()
    names = robot.geometry.dimensions()
    values = {name: getattr(robot.geometry, name) for name in names}
    return {name: value for name, value in values.items() if value != getattr(default, name)}
