"""See help(tendril)."""
import sys as _sys

from . import _tendril
from ._tendril import *  # noqa: F403
from ._tendril import __version__  # noqa: F401

__doc__ = _tendril.__doc__
__all__ = [name for name in vars(_tendril) if not name.startswith("_")]
_sys.modules[__name__ + ".signal"] = signal  # noqa: F405  so that `import tendril.signal` finds it
