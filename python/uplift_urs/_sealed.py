"""Result files: every byte is checked before HDF5, which may never return from a damaged file, sees one."""

from __future__ import annotations

import hashlib
import os
import re
import stat
from pathlib import Path
from typing import Any

from ._optional import optional

# the last line of a result (docs/hdf5-layout.md)
_SEAL = re.compile(rb"\nuplift: SHA-256 of everything before this line: ([0-9a-f]{64})\n")
_SEAL_BYTES = 114
_SIGNATURE = b"\x89HDF\r\n\x1a\n"
_BYTES_AT_A_TIME = 1 << 20


class SealedFile:
    """A result file, which is not kept open.

    Attributes
    ----------
    path : pathlib.Path
    verify : bool
        Whether its bytes are checked: when it is first opened, and again after it has changed.
    """

    def __init__(self, path: Path, verify: bool) -> None:
        self.path, self.verify = path, verify
        # of the bytes that were last found whole
        self._whole_as: tuple[int, ...] | None = None

    def open(self) -> Any:
        """The file, to be closed by `with`.

        Raises
        ------
        OSError
            For a file that is missing, damaged, or not HDF5.
        """
        h5py = optional("h5py", "results")
        found = os.stat(self.path)
        if not stat.S_ISREG(found.st_mode):
            # a pipe would be waited for
            raise OSError(f"{self.path}: is not a file: give the result that `uplift run` wrote")
        seen = (found.st_dev, found.st_ino, found.st_size, found.st_mtime_ns)
        if self.verify and self._whole_as != seen:
            _require_whole(self.path)
            self._whole_as = seen
        return h5py.File(self.path, "r")


def _require_whole(path: Path) -> None:
    """Refuses a file that has changed since it was written."""
    with open(path, "rb") as file:
        if file.read(len(_SIGNATURE)) != _SIGNATURE:
            raise OSError(f"{path}: is not an HDF5 file: give the result that `uplift run` wrote")
        covered = max(file.seek(0, os.SEEK_END) - _SEAL_BYTES, 0)
        file.seek(covered)
        seal = _SEAL.fullmatch(file.read())
        if seal is None:
            raise OSError(
                f"{path}: the checksum at its end is missing: another program has changed it, or it is cut short: "
                "use another copy or repeat the run; verify=False opens it unchecked"
            )
        file.seek(0)
        digest = hashlib.sha256()
        while covered:
            read = file.read(min(covered, _BYTES_AT_A_TIME))
            if not read:
                break
            digest.update(read)
            covered -= len(read)
    if digest.hexdigest().encode() != seal[1]:
        raise OSError(f"{path}: it has changed since it was written: use another copy or repeat the run")
