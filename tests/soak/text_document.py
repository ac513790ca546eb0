"""A client's copy of a text: it counts and edits as the language server protocol says."""

import os.path
import re

LINE_END = re.compile(r"\r\n|\r|\n")


def units(character: str, encoding: str) -> int:
    """Of a character in a column."""
    if encoding == "utf-32":
        return 1
    if encoding == "utf-16":
        return 2 if ord(character) > 0xFFFF else 1
    return len(character.encode())


def whole_characters(text: str) -> str:
    """Half a surrogate pair is no character."""
    return re.sub("[\ud800-\udfff]", "\ufffd", text)


class TextDocument:
    def __init__(self, uri: str, text: str, version: int = 1):
        self.uri = uri
        self.version = version
        self.history: list[str] = []  # Earlier texts, the latest last.
        self.text = ""
        self.set_text(text)

    def set_text(self, text: str) -> None:
        self.text = text
        ends = list(LINE_END.finditer(text))
        self.starts = [0] + [each.end() for each in ends]
        self.ends = [each.start() for each in ends] + [len(text)]

    def line_count(self) -> int:
        return len(self.starts)

    def line(self, number: int) -> str:
        return self.text[self.starts[number] : self.ends[number]]

    def offset(self, position: dict, encoding: str) -> int:
        """A column in the middle of a character is before it, and one after the end is the end."""
        if position["line"] >= self.line_count():
            return len(self.text)
        line = self.line(position["line"])
        if line.isascii():
            return self.starts[position["line"]] + min(position["character"], len(line))
        passed = 0
        for index, character in enumerate(line):
            passed += units(character, encoding)
            if passed > position["character"]:
                return self.starts[position["line"]] + index
        return self.ends[position["line"]]

    def position(self, line: int, column: int, encoding: str) -> dict:
        """Of a character of a line."""
        return {"line": line, "character": sum(units(each, encoding) for each in self.line(line)[:column])}

    def end(self, encoding: str) -> dict:
        return self.position(self.line_count() - 1, len(self.line(self.line_count() - 1)), encoding)

    def remember(self) -> None:
        self.history = [*self.history[-9:], self.text]

    def edit(self, changes: list[dict], encoding: str) -> dict:
        """Makes the changes, one after another; the parameters of didChange."""
        self.remember()
        self.version += 1
        for change in changes:
            if "range" not in change:
                self.set_text(whole_characters(change["text"]))
                continue
            start = self.offset(change["range"]["start"], encoding)
            end = self.offset(change["range"]["end"], encoding)
            self.set_text(self.text[:start] + whole_characters(change["text"]) + self.text[end:])
        return {"textDocument": {"uri": self.uri, "version": self.version}, "contentChanges": changes}

    def change_to(self, text: str, encoding: str) -> dict:
        """The one change that leads to a text."""
        before = len(os.path.commonprefix([self.text, text]))
        after = len(os.path.commonprefix([self.text[before:][::-1], text[before:][::-1]]))
        # Not between the two characters of a line end, where there is no column.
        while before > 0 and (self.text[before - 1] == "\r" or text[before - 1 : before] == "\r"):
            before -= 1
        while after > 0 and self.text[-after] == "\n":
            after -= 1
        places = []
        for offset in (before, len(self.text) - after):
            line = max(0, next((i for i, start in enumerate(self.starts) if start > offset), self.line_count()) - 1)
            places.append(self.position(line, offset - self.starts[line], encoding))
        return {"range": {"start": places[0], "end": places[1]}, "text": text[before : len(text) - after]}
