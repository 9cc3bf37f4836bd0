"""Russian words for whole numbers: quantities, ordinals in their cases, decimals and years."""

from __future__ import annotations

_SMALL = (
    "ноль", "один", "два", "три", "четыре", "пять", "шесть", "семь", "восемь", "девять", "десять",
    "одиннадцать", "двенадцать", "тринадцать", "четырнадцать", "пятнадцать", "шестнадцать",
    "семнадцать", "восемнадцать", "девятнадцать",
)  # fmt: skip
_GENITIVE = ("ноля", "одного", "двух", "трёх", "четырёх", "пяти", "шести", "семи", "восьми")
_FEMININE = {1: "одна", 2: "две"}
_TENS = (
    "", "", "двадцать", "тридцать", "сорок", "пятьдесят", "шестьдесят", "семьдесят", "восемьдесят",
    "девяносто",
)  # fmt: skip
_HUNDREDS = (
    "", "сто", "двести", "триста", "четыреста", "пятьсот", "шестьсот", "семьсот", "восемьсот",
    "девятьсот",
)  # fmt: skip
_STEMS = (
    "", "перв", "втор", "трет", "четвёрт", "пят", "шест", "седьм", "восьм", "девят", "десят",
    "одиннадцат", "двенадцат", "тринадцат", "четырнадцат", "пятнадцат", "шестнадцат", "семнадцат",
    "восемнадцат", "девятнадцат",
)  # fmt: skip
_TEN_STEMS = (
    "", "", "двадцат", "тридцат", "сороков", "пятидесят", "шестидесят", "семидесят", "восьмидесят",
    "девяност",
)  # fmt: skip
_HUNDRED_STEMS = (
    "", "сот", "двухсот", "трёхсот", "четырёхсот", "пятисот", "шестисот", "семисот", "восьмисот",
    "девятисот",
)  # fmt: skip
# Stressed on the ending.
_STRESSED = ("втор", "шест", "седьм", "восьм", "сороков")
_SOFT = {
    "ый": "ий", "ого": "ьего", "ому": "ьему", "ым": "ьим", "ом": "ьем", "ая": "ья", "ую": "ью", "ое": "ье",
    "ые": "ьи", "ых": "ьих", "ой": "ьей",
}  # fmt: skip
_PARTS = {1: ("десятая", "десятых"), 2: ("сотая", "сотых"), 3: ("тысячная", "тысячных")}


def cardinal(number: int, *, feminine: bool = False) -> str:
    """Return a whole number below a million.

    >>> cardinal(21, feminine=True), cardinal(1998)
    ('двадцать одна', 'тысяча девятьсот девяносто восемь')
    """
    if number < 20:
        return _FEMININE.get(number, _SMALL[number]) if feminine else _SMALL[number]
    if number < 1000:
        tens = number < 100
        head, rest = (_TENS[number // 10], number % 10) if tens else (_HUNDREDS[number // 100], number % 100)
        return f"{head} {cardinal(rest, feminine=feminine)}" if rest else head
    thousands, rest = divmod(number, 1000)
    last = thousands % 10 if thousands % 100 not in range(11, 15) else 0
    name = "тысяча" if last == 1 else "тысячи" if last in (2, 3, 4) else "тысяч"
    head = name if thousands == 1 else f"{cardinal(thousands, feminine=True)} {name}"
    return f"{head} {cardinal(rest, feminine=feminine)}" if rest else head


def genitive(number: int) -> str:
    """Return a whole number below 30 in the genitive.

    >>> genitive(2), genitive(9), genitive(21)
    ('двух', 'девяти', 'двадцати одного')
    """
    if number < len(_GENITIVE):
        return _GENITIVE[number]
    if number <= 20:
        return cardinal(number).removesuffix("ь") + "и"
    return f"двадцати {genitive(number - 20)}"


def ordinal(number: int, ending: str) -> str:
    """Return a whole number from 1 to 2999 as an ordinal; only its last word changes.

    `ending`: that of a hard stem: ый, ого, ому, ым, ом, ая, ую, ой, ое, ые or ых.

    >>> ordinal(1998, "ом"), ordinal(3, "ый"), ordinal(20, "ого"), ordinal(2000, "ого")
    ('тысяча девятьсот девяносто восьмом', 'третий', 'двадцатого', 'двухтысячного')
    """
    last = number % 100
    if last in (0, *range(20, 100, 10)):
        stem, size = (
            (_TEN_STEMS[last // 10], last) if last else (_HUNDRED_STEMS[number // 100 % 10], number % 1000)
        )
    else:
        size = last if last < 20 else last % 10
        stem = _STEMS[size]
    if size == 0:
        stem, size = ("двухтысячн" if number == 2000 else "тысячн"), number
    head = number - size
    words = _with_ending(stem, ending)
    return f"{cardinal(head)} {words}" if head else words


def decimal(whole: int, decimals: str) -> str:
    """Return a number with one to three decimals.

    >>> decimal(12, "50"), decimal(1, "1"), decimal(0, "02")
    ('двенадцать целых пятьдесят сотых', 'одна целая одна десятая', 'ноль целых две сотых')
    """
    part, of = int(decimals), _PARTS[len(decimals)]
    return (
        f"{cardinal(whole, feminine=True)} {'целая' if _is_one(whole) else 'целых'} "
        f"{cardinal(part, feminine=True)} {of[0] if _is_one(part) else of[1]}"
    )


def _is_one(number: int) -> bool:
    return number % 10 == 1 and number % 100 != 11


def _with_ending(stem: str, ending: str) -> str:
    if stem == "трет":
        return stem + _SOFT[ending]
    return stem + ("ой" if ending == "ый" and stem in _STRESSED else ending)
