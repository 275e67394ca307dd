"""Numbers as sentences have them, the same as in crossgrain's reports."""

import math

_SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def _exponent(value, digits):
    return 0 if value == 0 else int(f"{value:.{digits - 1}e}".split("e")[1])


def _plain(exponent):
    return -3 <= exponent <= 5


def _typeset(number):
    """A true minus sign, and narrow spaces between thousands."""
    sign, number = ("−", number[1:]) if number.startswith("-") else ("", number)
    whole, point, rest = number.partition(".")
    if len(whole) > 4:
        whole = f"{int(whole):,}".replace(",", "\u202f")
    return sign + whole + point + rest


def _fixed(value, decimals):
    number = f"{value:.{max(decimals, 0)}f}"
    return _typeset(number.lstrip("-") if not number.strip("-0.") else number)


def _power(exponent):
    return "×10" + str(exponent).translate(_SUPERSCRIPTS)


def setting(value):
    """What somebody chose: up to four digits."""
    number, mark, exponent = f"{value:.4g}".partition("e")
    return _typeset(number) + (_power(int(exponent)) if mark else "")


def readable(value, error=None):
    """Three digits; with an error, as many as two digits of that have."""
    if value is None or not math.isfinite(value):
        return "–"
    if error is None or not math.isfinite(error) or error == 0:
        if value == 0:
            return "0"
        exponent = _exponent(value, 3)
        return _fixed(value, 2 - exponent) if _plain(exponent) else _fixed(value / 10.0**exponent, 2) + _power(exponent)
    larger = max(abs(value), abs(error))
    magnitude = _exponent(larger, 3)
    shift = 0 if _plain(magnitude) else magnitude
    decimals = 1 - _exponent(error, 2) + shift
    most = 5 - _exponent(larger, 6) + shift
    scale = 10.0**shift
    if decimals > most:  # the error has a power of ten of its own
        own = _exponent(error, 2)
        small = _fixed(error, 1 - own) if _plain(own) else _fixed(error / 10.0**own, 1) + _power(own)
        return _fixed(value / scale, most) + (_power(shift) if shift else "") + "\u00a0±\u00a0" + small
    both = _fixed(value / scale, decimals) + "\u00a0±\u00a0" + _fixed(error / scale, decimals)
    return f"({both}){_power(shift)}" if shift else both
