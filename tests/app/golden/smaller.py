#!/usr/bin/env python3
"""Packs PNG files more tightly, losslessly: RGB without an alpha that says nothing, and zlib's best effort."""
import struct
import sys
import zlib


def unfilter(kind, row, above, step):
    for x in range(len(row)):
        left = row[x - step] if x >= step else 0
        up = above[x]
        corner = above[x - step] if x >= step else 0
        if kind == 1:
            guess = left
        elif kind == 2:
            guess = up
        elif kind == 3:
            guess = (left + up) // 2
        else:
            estimate = left + up - corner
            off = (abs(estimate - left), abs(estimate - up), abs(estimate - corner))
            guess = (left, up, corner)[off.index(min(off))]
        row[x] = (row[x] + guess) & 255
    return row


def chunks(png):
    at = 8
    while at < len(png):
        length, = struct.unpack(">I", png[at:at + 4])
        yield png[at + 4:at + 8], png[at + 8:at + 8 + length]
        at += 12 + length


def rows_of(png):
    """Width, height and the rows as RGB; None for a PNG of another kind than the program writes."""
    parts = list(chunks(png))
    width, height, depth, colours, _, _, interlaced = struct.unpack(">IIBBBBB", parts[0][1])
    if depth != 8 or colours != 6 or interlaced:
        return None
    raw = zlib.decompress(b"".join(data for kind, data in parts if kind == b"IDAT"))
    rows, above, size = [], bytearray(4 * width), 4 * width
    for y in range(height):
        start = y * (size + 1)
        row = bytearray(raw[start + 1:start + 1 + size])
        if raw[start]:
            row = unfilter(raw[start], row, above, 4)
        above = row
        rgb = bytearray(3 * width)
        for channel in range(3):
            rgb[channel::3] = row[channel::4]
        rows.append(rgb)
    return width, height, rows


def packed(width, height, rows):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    data = zlib.compress(b"".join(b"\0" + row for row in rows), 9)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", data) + chunk(b"IEND", b"")


for path in sys.argv[1:]:
    with open(path, "rb") as file:
        before = file.read()
    found = rows_of(before)
    if found and len(after := packed(*found)) < len(before):
        with open(path, "wb") as file:
            file.write(after)
