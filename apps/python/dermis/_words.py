"""Python's values as the texts that the command line has: the parsers and their tables are the program's own."""

import os
from collections.abc import Iterable, Mapping
from typing import Union

import numpy

from dermis import _dermis

Path = Union[str, "os.PathLike[str]"]
Size = Union[int, str, "tuple[int, int]"]
"""Of a picture or a table in pixels: 512, "1024x768" or (1024, 768)."""
Words = Union["Mapping[str, object]", "Iterable[str]", str, None]
"""{key: value}, or the command line's texts KEY=VALUE."""


def number_text(value):
    """A number, a text, a bool, or several numbers with commas between."""
    if isinstance(value, str):
        return value
    if isinstance(value, (bool, numpy.bool_)):
        return "true" if value else "false"
    if isinstance(value, (int, numpy.integer)):
        return str(int(value))
    if isinstance(value, (float, numpy.floating)):
        return repr(float(value))
    try:
        return ",".join(number_text(item) for item in value)
    except TypeError:
        raise TypeError(f"{value!r}: must be a text, a number, a bool or several numbers") from None


def profile_text(value, option="profile"):
    """A name, or that of a Profile; None stays."""
    if value is None:
        return value
    if isinstance(value, (str, os.PathLike)):
        return text_path(value)
    if hasattr(value, "_profile"):
        return _dermis.keep_profile(value._profile)
    raise TypeError(f"{option}: must be a Profile or its name")


def words(values, option):
    """KEY=VALUE texts of a mapping, or the texts of a list."""
    if values is None:
        return []
    if isinstance(values, str):
        return [values]
    if hasattr(values, "items"):
        return [f"{key}={_value_text(value, f'{option}: {key}')}" for key, value in values.items()]
    texts = list(values)
    if not all(isinstance(text, str) for text in texts):
        raise TypeError(f"{option}: must be a mapping, or texts KEY=VALUE")
    return texts


def _value_text(value, option):
    return profile_text(value, option) if hasattr(value, "_profile") else number_text(value)


def scene_arguments(scene, keys, camera, light, clip, time, morph):
    """What the command line takes as SCENE, --scene, --camera, --light, --clip, --time and --morph."""
    return (text_path(scene), words(keys, "keys"), " ".join(words(camera, "camera")),
            " ".join(words(light, "light")), (clip, time, words(morph, "morph")))


def size_text(size):
    """512, "1024x768" or (width, height)."""
    if isinstance(size, (str, int, numpy.integer)):
        return str(size)
    return "x".join(str(side) for side in size)


def range_text(ends):
    """(min, max) as MIN,MAX."""
    return "" if ends is None else number_text(ends)


def text_path(path):
    """A path or a name as text. C would end it at a NUL, and another file be written."""
    text = os.fspath(path)
    if (b"\0" if isinstance(text, bytes) else "\0") in text:
        raise _dermis.Error(f"{text!r}: a file's name has no NUL")
    return text


def given(**options):
    """Only those that are not None."""
    return {name: value for name, value in options.items() if value is not None}


def whole(value, option, least, most):
    """A whole number within C's range; the parsers check the rest."""
    if isinstance(value, (bool, numpy.bool_)) or not isinstance(value, (int, numpy.integer)):
        raise TypeError(f"{option}: {value!r} is not a whole number")
    if not least <= value <= most:
        raise _dermis.Error(f"--{option.replace('_', '-')} {value}: must be {least} to {most}")
    return int(value)
