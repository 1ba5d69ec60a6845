"""The command line: one sentence for a mistake, a quick and silent end on Ctrl-C."""

from __future__ import annotations

import asyncio
import os
import re
import socket
import subprocess
import sys
from pathlib import Path

import pytest

from app import __version__
from app.cli import EXIT_INTERRUPTED, EXIT_MISTAKE, main
from app.errors import UserMistake
from app.robots import ROBOTS
from app.ui.options import ServeOptions
from tests.support.server import DELTALAB, HOST, ServerFactory, running_deltalab
from tests.support.wire import run_async, wire_client


def assert_one_sentence(text: str) -> None:
    assert text.endswith((".\n", ".", "?).\n"))
    assert len(text.strip().splitlines()) == 1, text
    assert not set("│╭╰─") & set(text), text
    assert ". " not in text, text


@pytest.fixture
def served(monkeypatch: pytest.MonkeyPatch) -> list[ServeOptions]:
    """What would be served, in place of serving it."""
    options: list[ServeOptions] = []
    monkeypatch.setattr("app.commands.serve", options.append)
    return options


def test_defaults(served: list[ServeOptions]) -> None:
    assert main([]) == 0
    assert served == [ServeOptions("127.0.0.1", 8080, "par4", open_browser=True, allowed_hosts=())]


def test_every_option(served: list[ServeOptions]) -> None:
    line = "--host 0.0.0.0 --port 9000 --robot delta3 --no-browser --no-shadows"
    hosts = "--allow-host a.example --allow-host b.example"
    assert main([*line.split(), *hosts.split()]) == 0
    assert served == [ServeOptions("0.0.0.0", 9000, "delta3", False, False, ("a.example", "b.example"))]


@pytest.mark.parametrize("robot", ROBOTS)
def test_every_robot_can_be_chosen(served: list[ServeOptions], robot: str) -> None:
    assert main(["--robot", robot]) == 0
    assert served[0].robot == robot


@pytest.mark.parametrize(
    ("line", "says"),
    [
        ("--port 99999", "99999 is not a port"),
        ("--port 0", "0 is not a port"),
        ("--port eighty", "'eighty' is not a whole number"),
        ("--port", "--port"),
        ("--robot foo", "choose one of par4"),
        ("--prot 5", "did you mean --port?"),
        ("--wat", "--wat"),
        ("dance", "no command 'dance'"),
        ("meshes --directry x", "did you mean --directory?"),
        ("reproduce --paper foo", "no paper 'foo'"),
        ("reproduce --papr par4", "did you mean --paper?"),
    ],
)
@pytest.mark.parametrize("columns", ["80", "30"])
def test_a_mistake_gets_one_sentence(
    line: str, says: str, columns: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("COLUMNS", columns)
    assert main(line.split()) == EXIT_MISTAKE
    printed = capsys.readouterr()
    assert printed.out == ""
    assert says in printed.err
    assert_one_sentence(printed.err)


@pytest.mark.parametrize("encoding", ["utf-8", "ascii"])
def test_a_mistake_as_the_shell_sees_it(encoding: str) -> None:
    environment = {**os.environ, "PYTHONIOENCODING": encoding}
    result = subprocess.run([*DELTALAB, "--robot", "foo"], capture_output=True, text=True, env=environment)
    assert result.returncode == EXIT_MISTAKE
    assert result.stdout == ""
    assert "there is no robot 'foo'" in result.stderr
    assert_one_sentence(result.stderr)


def test_help_names_every_option_and_command(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as leaving:
        main(["--help"])
    assert leaving.value.code == 0
    printed = capsys.readouterr().out
    options = ("--host", "--port", "--robot", "--no-browser", "--allow-host")
    for word in (*options, "deltalab meshes", "deltalab reproduce", *ROBOTS):
        assert word in printed


def test_version(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["--version"]) == 0
    assert capsys.readouterr().out == f"deltalab {__version__}\n"


def test_mistakes_found_while_serving_are_sentences_too(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def refuse(options: ServeOptions) -> None:
        raise UserMistake("The port is taken.")

    monkeypatch.setattr("app.commands.serve", refuse)
    assert main([]) == EXIT_MISTAKE
    assert capsys.readouterr().err == "The port is taken.\n"


def test_interrupted_before_the_server_runs(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def interrupt(options: ServeOptions) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("app.commands.serve", interrupt)
    assert main([]) == EXIT_INTERRUPTED
    assert capsys.readouterr().err == ""


def test_imports_happen_where_control_c_is_heeded() -> None:
    script = "import sys, app.cli; print({'tyro', 'numpy', 'viser', 'app.commands'} & set(sys.modules))"
    result = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
    assert result.stdout == "set()\n", result.stderr


def test_meshes_are_written_where_asked(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    folder = tmp_path / "parts"
    assert main(["meshes", "--directory", str(folder)]) == 0
    written = {Path(line) for line in capsys.readouterr().out.splitlines()}
    assert written == {path for path in folder.rglob("*") if path.is_file()}
    assert all(path.suffix == ".glb" and path.stat().st_size > 0 for path in written)
    assert written


def test_a_folder_that_cannot_be_written(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "file").write_text("in the way")
    assert main(["meshes", "--directory", str(tmp_path / "file" / "parts")]) == EXIT_MISTAKE
    assert_one_sentence(capsys.readouterr().err)


def test_a_taken_port_is_refused() -> None:
    with socket.socket() as holder:
        holder.bind((HOST, 0))
        holder.listen()
        port = holder.getsockname()[1]
        result = subprocess.run(
            [*DELTALAB, "--no-browser", "--port", str(port)], capture_output=True, text=True, timeout=60
        )
    assert result.returncode == EXIT_MISTAKE
    assert str(port) in result.stderr
    assert_one_sentence(result.stderr)


def test_the_address_is_printed(running_server: ServerFactory) -> None:
    server = running_server("--robot", "delta3")
    address = re.compile(rf"http://(localhost|{HOST}):{server.port}\b")
    assert address.search(server.wait_for_output(f":{server.port}"))


def test_control_c_ends_it_without_a_trace() -> None:
    with running_deltalab() as server:
        server.stop()
    with socket.socket() as successor:
        successor.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        successor.bind((HOST, server.port))


def test_control_c_ends_it_with_a_visitor_too(running_server: ServerFactory) -> None:
    server = running_server()

    async def visit() -> None:
        async with wire_client(server.url) as visitor:
            await visitor.wait_for(lambda: "/robot/gizmo" in visitor.nodes, "gizmo")
            await asyncio.to_thread(server.stop)

    run_async(visit())
