# SPDX-License-Identifier: Apache-2.0
"""A small stand-in of Gymnasium for the tests: base classes of the same names that hold us to the same rules.

What of Gymnasium our environments use, or what uses them, is said again here in as few words as do.
"""

from . import spaces, vector
from .core import Env
from .envs.registration import make, make_vec, registry

__version__ = "stand-in"
__all__ = ["Env", "make", "make_vec", "registry", "spaces", "vector"]
