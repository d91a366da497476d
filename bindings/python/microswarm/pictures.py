# SPDX-License-Identifier: Apache-2.0
"""Pictures of what can be drawn."""

from __future__ import annotations

import os
from typing import Optional

from .values import InputError, path_text


class Drawable:
    """What has a picture: a notebook shows it, and draw() writes it."""

    def _picture(self, file: Optional[str]) -> Optional[bytes]:
        """Writes the picture into `file`; without one it returns it as PNG, or nothing."""
        raise NotImplementedError

    def draw(self, path: str | os.PathLike[str]) -> None:
        """Writes a picture of it into a file: .png, .svg or .pdf."""
        self._picture(path_text(path))

    def _repr_png_(self) -> Optional[bytes]:
        try:
            return self._picture(None)
        except InputError:  # such as a closed session
            return None
