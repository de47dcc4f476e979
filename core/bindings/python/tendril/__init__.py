"""See help(tendril)."""
from . import _tendril
from ._tendril import *  # noqa: F403
from ._tendril import __version__  # noqa: F401

__doc__ = _tendril.__doc__
__all__ = [name for name in vars(_tendril) if not name.startswith("_")]
