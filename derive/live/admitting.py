"""Which requests are answered.

A web page from elsewhere can reach a server on 127.0.0.1 too. So nothing is answered but to a request whose
Host is ours (a name that was bound to 127.0.0.1 afterwards is none), that no other page made (Origin,
Sec-Fetch-Site), and whose path begins with a token that only the terminal has shown. No path leads to a file.
"""

from __future__ import annotations

from email.message import Message
from hmac import compare_digest
from http import HTTPStatus

HERE = "127.0.0.1"
OURS = ("same-origin", "none")  # "none": the reader typed the address


def asked(path: str, headers: Message, port: int, token: str, writes: bool) -> str | HTTPStatus:
    """What stands behind the token, or why that is not answered. What `writes` needs an Origin, as every
    browser gives it."""
    host = headers.get_all("Host", [])
    origin = headers.get_all("Origin", [])
    if len(host) != 1 or host[0] not in (f"{HERE}:{port}", f"localhost:{port}"):
        return HTTPStatus.MISDIRECTED_REQUEST
    if any(each != f"http://{host[0]}" for each in origin) or (writes and not origin):
        return HTTPStatus.FORBIDDEN
    if any(each not in OURS for each in headers.get_all("Sec-Fetch-Site", [])):
        return HTTPStatus.FORBIDDEN
    before, _, rest = path.partition("/")
    given, slash, wanted = rest.partition("?")[0].partition("/")
    if before or not slash or not compare_digest(given.encode(), token.encode()):
        return HTTPStatus.NOT_FOUND
    return wanted
