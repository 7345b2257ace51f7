"""What is raised for files that cannot be read."""

from __future__ import annotations

from typing import Any, Optional, Tuple


class FileError(OSError):
    """A file that cannot be read or written, with the place where it went wrong.

    Attributes:
        file: the file's path
        line: line counted from 1 (text files), or None
        byte_offset: offset from the start of the file (binary files), or None
    """

    def __init__(
        self, message: str, file: str = "", line: Optional[int] = None, byte_offset: Optional[int] = None
    ) -> None:
        super().__init__(message)
        self.file = file
        self.line = line
        self.byte_offset = byte_offset

    def __reduce__(self) -> Tuple[Any, ...]:
        return FileError, (str(self), self.file, self.line, self.byte_offset)
