"""Reads the PNG files that ramus writes: eight bits a channel, not interlaced."""

import struct
import zlib


def _paeth(left, above, corner):
    near = [abs(above - corner), abs(left - corner), abs(left + above - 2 * corner)]
    return (left, above, corner)[near.index(min(near))]


class Picture:
    def __init__(self, content):
        self.width, self.height, depth, kind = struct.unpack(">IIBB", content[16:26])
        assert content[:8] == b"\x89PNG\r\n\x1a\n" and depth == 8 and kind in (2, 6)
        self.channels = 3 if kind == 2 else 4
        data, at = b"", 8
        while at < len(content):
            length, = struct.unpack(">I", content[at:at + 4])
            if content[at + 4:at + 8] == b"IDAT":
                data += content[at + 8:at + 8 + length]
            at += 12 + length
        self.rows = self._rows(zlib.decompress(data))

    def _rows(self, data):
        bytes_a_row, pixel = self.channels * self.width, self.channels
        rows, above = [], bytearray(bytes_a_row)
        for y in range(self.height):
            start = y * (bytes_a_row + 1)
            filtered, row = data[start], bytearray(data[start + 1:start + 1 + bytes_a_row])
            for x in range(bytes_a_row if filtered else 0):
                left = row[x - pixel] if x >= pixel else 0
                corner = above[x - pixel] if x >= pixel else 0
                guess = (0, left, above[x], (left + above[x]) // 2, _paeth(left, above[x], corner))[filtered]
                row[x] = row[x] + guess & 255
            rows.append(bytes(row))
            above = row
        return rows

    def pixel(self, x, y):
        return tuple(self.rows[y][self.channels * x:self.channels * x + 3])

    def part(self, x, y, width, height):
        """Of the picture, as bytes."""
        return b"".join(row[self.channels * x:self.channels * (x + width)] for row in self.rows[y:y + height])
