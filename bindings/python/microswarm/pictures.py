# SPDX-License-Identifier: Apache-2.0
"""Drawing of records, sessions, maps and paths."""

from __future__ import annotations

import os
from typing import Optional

from .values import InputError, path_text


class Drawable:
    """Base of objects with a picture, which a notebook shows and draw() writes."""

    def _picture(self, file: Optional[str]) -> Optional[bytes]:
        """Writes the picture into `file`; without a file returns it as PNG, or None."""
        raise NotImplementedError

    def draw(self, path: str | os.PathLike[str]) -> None:
        """Writes a picture into a file: .png, .svg or .pdf."""
        self._picture(path_text(path))

    def _repr_png_(self) -> Optional[bytes]:
        try:
            return self._picture(None)
        except InputError:  # for example a closed session
            return None
