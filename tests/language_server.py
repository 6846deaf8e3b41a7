"""A client of yaml-language-server, which editors ask about YAML: opens sheets, asks what is said of them."""

from __future__ import annotations

import json
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from itertools import count
from pathlib import Path
from typing import IO, Any, TypeAlias

Message: TypeAlias = dict[str, Any]
SETTINGS = {"validate": True, "hover": True, "completion": True, "schemaStore": {"enable": False}}
CAPABILITIES = {"textDocument": {"hover": {"contentFormat": ["plaintext"]}}}
MARK = "|"  # where the cursor is


class LanguageServer:
    """A running server; sheets are written into its folder."""

    def __init__(self, sent: IO[bytes], received: IO[bytes], folder: Path) -> None:
        self._sent, self._received, self._folder = sent, received, folder
        self._numbers, self._marked = count(1), dict[str, list[Message]]()
        self._ask("initialize", {"rootUri": folder.as_uri(), "capabilities": CAPABILITIES, "processId": None})
        self._send({"method": "initialized", "params": {}})

    def marked(self, sheet: str) -> list[tuple[int, str]]:
        """What is underlined: the line, counted from 1, and the message."""
        address = self._opened(sheet)
        while address not in self._marked:
            self._answer(self._receive())
        return [(each["range"]["start"]["line"] + 1, each["message"]) for each in self._marked[address]]

    def offered(self, sheet: str) -> dict[str, str]:
        """What could be typed at the mark, with what is said of each."""
        found = self._at_mark("completion", sheet)
        return {each["label"]: str(each.get("documentation", "")) for each in found["items"]}

    def said(self, sheet: str) -> str:
        """What is shown of the word at the mark."""
        found = self._at_mark("hover", sheet)
        return str(found["contents"]["value"])

    def _at_mark(self, asked: str, sheet: str) -> Any:
        before, _, after = sheet.partition(MARK)
        place = {"line": before.count("\n"), "character": len(before.rpartition("\n")[2])}
        document = {"uri": self._opened(before + after)}
        return self._ask(f"textDocument/{asked}", {"textDocument": document, "position": place})

    def _opened(self, sheet: str) -> str:
        path = self._folder / f"sheet-{next(self._numbers)}.yaml"
        path.write_text(sheet, encoding="utf-8")
        document = {"uri": path.as_uri(), "languageId": "yaml", "version": 1, "text": sheet}
        self._send({"method": "textDocument/didOpen", "params": {"textDocument": document}})
        return path.as_uri()

    def _ask(self, method: str, params: Message) -> Any:
        number = next(self._numbers)
        self._send({"id": number, "method": method, "params": params})
        while True:
            message = self._receive()
            if message.get("id") == number and "method" not in message:
                return message["result"]
            self._answer(message)

    def _answer(self, message: Message) -> None:
        """Keeps what is marked; tells the settings that are asked for."""
        if message.get("method") == "textDocument/publishDiagnostics":
            self._marked[message["params"]["uri"]] = message["params"]["diagnostics"]
        elif message.get("method") == "workspace/configuration":
            asked = [each.get("section") for each in message["params"]["items"]]
            told = [SETTINGS if section == "yaml" else {} for section in asked]
            self._send({"id": message["id"], "result": told})
        elif "method" in message and "id" in message:
            self._send({"id": message["id"], "result": None})

    def _send(self, message: Message) -> None:
        body = json.dumps({"jsonrpc": "2.0", **message}).encode()
        self._sent.write(b"Content-Length: %d\r\n\r\n%b" % (len(body), body))
        self._sent.flush()

    def _receive(self) -> Message:
        length = 0
        while header := self._received.readline().strip():
            name, _, value = header.partition(b":")
            length = int(value) if name.lower() == b"content-length" else length
        message: Message = json.loads(self._received.read(length))
        return message


@contextmanager
def language_server(command: Path, folder: Path) -> Iterator[LanguageServer]:
    """A server that is ended when it is no longer needed."""
    pipe = subprocess.PIPE
    with subprocess.Popen(["node", command, "--stdio"], stdin=pipe, stdout=pipe) as process:
        assert process.stdin is not None
        assert process.stdout is not None
        try:
            yield LanguageServer(process.stdin, process.stdout, folder)
        finally:
            process.kill()
