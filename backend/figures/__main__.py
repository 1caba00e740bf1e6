"""Draw what stands on standard input and write the files to standard output; see `drawing.draw_apart`."""

from __future__ import annotations

import sys

from backend.figures.drawing import DRAWINGS, join
from backend.figures.rendering import render


def main() -> None:
    """Draw once and end."""
    drawings = DRAWINGS.validate_json(sys.stdin.buffer.read())
    sys.stdout.buffer.write(join([render(drawing) for drawing in drawings]))


if __name__ == "__main__":
    main()
