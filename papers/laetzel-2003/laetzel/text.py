"""Numbers as sentences have them, the same as in crossgrain's reports."""

import math

_SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def _exponent(value, digits):
    return 0 if value == 0 else int(f"{value:.{digits - 1}e}".split("e")[1])


def _shift(exponent):
    """Powers of ten that are written apart."""
    return 0 if -3 <= exponent <= 5 else exponent


def _typeset(number, exponent=0):
    """A true minus sign, narrow spaces between thousands, and a power of ten."""
    whole, point, rest = number.lstrip("-").partition(".")
    sign = "−" if number.startswith("-") and number.strip("-0.") else ""
    whole = f"{int(whole):,}".replace(",", "\u202f") if len(whole) > 4 else whole
    return sign + whole + point + rest + ("×10" + str(exponent).translate(_SUPERSCRIPTS) if exponent else "")


def _fixed(value, decimals, shift):
    return _typeset(f"{value / 10.0**shift:.{max(decimals, 0)}f}", shift)


def setting(value):
    """What somebody chose: up to four digits."""
    number, _, exponent = f"{value:.4g}".partition("e")
    return _typeset(number, int(exponent or 0))


def readable(value, error=None):
    """Three digits; with an error, as many as two digits of that have."""
    if value is None or not math.isfinite(value):
        return "–"
    if not error or not math.isfinite(error):
        shift = _shift(_exponent(value, 3))
        return _fixed(value, 2 - _exponent(value, 3) + shift, shift) if value else "0"
    larger = max(abs(value), abs(error))
    shift = _shift(_exponent(larger, 3))
    decimals, most = 1 - _exponent(error, 2) + shift, 5 - _exponent(larger, 6) + shift
    if decimals > most:  # the error has a power of ten of its own
        own = _shift(_exponent(error, 2))
        return _fixed(value, most, shift) + "\u00a0±\u00a0" + _fixed(error, 1 - _exponent(error, 2) + own, own)
    both = "\u00a0±\u00a0".join(_typeset(f"{x / 10.0**shift:.{max(decimals, 0)}f}") for x in (value, error))
    return f"({both}){_typeset('', shift)}" if shift else both
