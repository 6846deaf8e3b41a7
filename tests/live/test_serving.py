"""What answers on 127.0.0.1, and to whom: raw requests, as hostile pages and programs would make them."""

from __future__ import annotations

import json
import socket
from collections.abc import Iterator

import pytest

from derive.live.serving import served
from derive.live.view import Shown, View
from derive.sheet.model import Steps

PAGE = "<!DOCTYPE html><title>A sheet</title><p>secret"


class Served:
    """A view that is served, and the steps that were asked for."""

    def __init__(self, address: str, shown: Shown, wished: list[Steps | None]) -> None:
        self.shown, self.wished = shown, wished
        host, self.token = address.removeprefix("http://").rstrip("/").split("/")
        self.port = int(host.split(":")[1])
        self.host = host

    def raw(self, request: bytes) -> tuple[int, str]:
        """The status and the whole answer."""
        with socket.create_connection(("127.0.0.1", self.port), timeout=10) as connection:
            connection.sendall(request)
            answer = b""
            while more := connection.recv(1 << 16):
                answer += more
        return int(answer.split()[1]), answer.decode()

    def ask(self, path: str, *headers: str, method: str = "GET", host: str | None = None) -> tuple[int, str]:
        lines = [
            f"{method} {path} HTTP/1.1",
            f"Host: {self.host if host is None else host}",
            *headers,
            "",
            "",
        ]
        return self.raw("\r\n".join(lines).encode())


@pytest.fixture
def site() -> Iterator[Served]:
    wished: list[Steps | None] = []
    shown = Shown(View(name="week1.yaml", page=PAGE, pages=1))
    with served(shown, 0, wished.append) as address:
        yield Served(address, shown, wished)


def test_the_reader_has_the_page(site: Served) -> None:
    for path, says in (("", "page.js"), ("page.js", "EventSource"), ("page.css", ":root"), ("sheet?1", PAGE)):
        status, answer = site.ask(f"/{site.token}/{path}", "Sec-Fetch-Site: none")
        assert (status, says in answer) == (200, True)
        assert "Content-Security-Policy: default-src 'none'" in answer
    assert "sandbox" in site.ask(f"/{site.token}/sheet")[1]
    assert site.ask(f"/{site.token}/sheet", host=f"localhost:{site.port}")[0] == 200


@pytest.mark.parametrize(
    "headers",
    [
        ["Host: evil.example"], ["Host: 127.0.0.1.evil.example:{port}"], ["Host: 127.0.0.1"],
        ["Host: [::1]:{port}"], [], ["Host: 127.0.0.1:{port}", "Host: evil.example"],
    ],
    ids=["another", "a-longer-name", "no-port", "another-address", "none", "two"],
)  # fmt: skip
def test_another_host_is_refused(headers: list[str], site: Served) -> None:
    """A name that leads to 127.0.0.1 for the second look-up: its page has the Host of that name."""
    lines = [line.format(port=site.port) for line in headers]
    status, answer = site.raw("\r\n".join([f"GET /{site.token}/sheet HTTP/1.1", *lines, "", ""]).encode())
    assert status == 421
    assert "secret" not in answer


@pytest.mark.parametrize(
    "header",
    ["Origin: https://evil.example", "Origin: null", "Origin: http://localhost:{port}",
     "Sec-Fetch-Site: cross-site", "Sec-Fetch-Site: same-site"],
)  # fmt: skip
def test_other_pages_are_refused(header: str, site: Served) -> None:
    status, answer = site.ask(f"/{site.token}/sheet", header.format(port=site.port))
    assert status == 403
    assert "secret" not in answer
    assert "Access-Control" not in answer


@pytest.mark.parametrize(
    "path",
    ["/", "/sheet", "/{short}/sheet", "/{token}", "/{token}x/sheet", "/{token}/../../etc/passwd",
     "/{token}/../page.html", "/{token}/%2e%2e/%2e%2e/etc/passwd", "/{token}//etc/passwd",
     "/{token}/page.html",
     "/{token}/week1.yaml", "/{token}/..%5c..%5csecret", "/../../../etc/passwd",
     "http://evil.example/{token}/sheet", "/{token}/sheet\0", "/{token}/s\xe4"],
)  # fmt: skip
def test_no_path_leads_elsewhere(path: str, site: Served) -> None:
    typed = path.format(token=site.token, short=site.token[:-1])
    status, answer = site.ask(typed)
    assert status in (400, 404)
    assert "secret" not in answer
    assert "root:" not in answer


def test_odd_requests_end_and_harm_nobody(site: Served) -> None:
    for request in (
        b"\r\n\r\n",
        b"GET\r\n\r\n",
        b"\x16\x03\x01\x02\x00\x01\x00\r\n\r\n",
        b"GET / HTTP/9\r\n\r\n",
    ):
        with socket.create_connection(("127.0.0.1", site.port), timeout=10) as connection:
            connection.sendall(request)
            connection.shutdown(socket.SHUT_WR)
            assert b"secret" not in connection.recv(1 << 16)
    assert site.ask("/" + "a" * 70_000)[0] == 414
    assert site.ask("/", *(f"X-{k}: 1" for k in range(200)))[0] == 431
    assert site.ask(f"/{site.token}/sheet", method="DELETE")[0] == 501
    assert site.ask(f"/{site.token}/sheet")[0] == 200


def test_steps_are_asked_for_by_the_page_alone(site: Served) -> None:
    own = f"Origin: http://{site.host}"
    assert site.ask(f"/{site.token}/steps/key", own, method="POST")[0] == 200
    assert site.ask(f"/{site.token}/steps", own, method="POST")[0] == 200
    assert site.ask(f"/{site.token}/steps/none", own, method="POST")[0] == 404
    assert site.ask(f"/{site.token}/steps/full", method="POST")[0] == 403
    assert site.ask(f"/{site.token}/steps/full", "Origin: http://evil.example", method="POST")[0] == 403
    assert site.ask("/steps/full", own, method="POST")[0] == 404
    assert site.wished == ["key", None]


def test_views_are_told_as_they_come_until_the_end(site: Served) -> None:
    with socket.create_connection(("127.0.0.1", site.port), timeout=10) as connection:
        connection.sendall(f"GET /{site.token}/views HTTP/1.1\r\nHost: {site.host}\r\n\r\n".encode())
        with connection.makefile("rb") as lines:
            events = (json.loads(line[6:]) for line in lines if line.startswith(b"data: "))
            assert next(events)["pages"] == 1
            site.shown.show(pages=2, page="another")
            told = next(events)
            assert told["pages"] == 2
            assert "page" not in told
            site.shown.end()
            assert next(events, None) is None


def test_it_listens_on_this_machine_alone(site: Served) -> None:
    with pytest.raises(OSError), served(site.shown, site.port, lambda _: None):
        pass
    with pytest.raises(OSError):
        socket.create_connection(("127.0.0.2", site.port), timeout=1)
