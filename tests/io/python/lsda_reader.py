"""Reads an LSDA file (binout) without any help from Kardan: an independent check of what the writer makes.

Layout: an 8-byte head (its own size, sizes of lengths, offsets, commands and types, byte order, float format), then
records of length, command, body. Symbol tables are chained by offsets and name every data record.
"""
import struct

SIGNED = {1: "b", 2: "h", 4: "i", 8: "q"}
TYPES = {1: "b", 2: "h", 3: "i", 4: "q", 5: "B", 6: "H", 7: "I", 8: "Q", 9: "f", 10: "d"}
CD, DATA, VARIABLE, BEGIN, END, OFFSET = 2, 3, 4, 5, 6, 7


class Lsda:
    def __init__(self, path):
        with open(path, "rb") as file:
            self.bytes = file.read()
        head = self.bytes[:8]
        self.order = "<" if head[5] == 1 else ">"
        self.length, self.offset, self.command, self.type = head[1], head[2], head[3], head[4]
        self.symbols = {}
        at = head[0]
        length, command = self._record(at)
        assert command == OFFSET and length == self.length + self.command + self.offset
        self.tables = 0
        table = self._integer(at + self.length + self.command, self.offset)
        while table != 0:
            table = self._table(table)

    def _integer(self, at, size):
        return struct.unpack_from(self.order + SIGNED[size], self.bytes, at)[0]

    def _record(self, at):
        return self._integer(at, self.length), self._integer(at + self.length, self.command)

    def _table(self, at):
        """Reads one symbol table; returns the offset of the next, 0 at the end."""
        self.tables += 1
        start = at
        length, command = self._record(at)
        assert command == BEGIN
        at += self.length + self.command
        folder = "/"
        while True:
            record, command = self._record(at)
            body = at + self.length + self.command
            if command == CD:
                folder = self.bytes[body:at + record].decode()
                assert folder.startswith("/")
            elif command == VARIABLE:
                tail = self.type + self.offset + self.length
                name = self.bytes[body:at + record - tail].decode()
                kind = self._integer(at + record - tail, self.type)
                offset = self._integer(at + record - self.offset - self.length, self.offset)
                count = self._integer(at + record - self.length, self.length)
                self.symbols[folder + "/" + name] = (kind, offset, count)
            else:
                assert command == END
                assert start + length == at + record
                return self._integer(body, self.offset)
            at += record

    def read(self, path):
        """The values of an array as a list, or the text of a text array."""
        kind, offset, count = self.symbols[path]
        length, command = self._record(offset)
        at = offset + self.length + self.command
        name = path.rsplit("/", 1)[1]
        name_length = self.bytes[at + self.type]
        assert command == DATA and self.bytes[at] == kind and name_length == len(name)
        at += self.type + 1
        assert self.bytes[at:at + name_length].decode() == name
        at += name_length
        assert length == at - offset + count * struct.calcsize(TYPES[kind])
        values = struct.unpack_from(f"{self.order}{count}{TYPES[kind]}", self.bytes, at)
        return bytes(values).decode() if kind == 1 else list(values)

    def folders(self, under):
        """Names of the folders directly under `under`."""
        prefix = under.rstrip("/") + "/"
        return sorted({p[len(prefix):].split("/")[0] for p in self.symbols if p.startswith(prefix)})
