from xml.sax.saxutils import quoteattr

import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.errors import InputError, Place
from risorius.script.elements import MAX_BYTES, read_elements

BOMB = """<?xml version="1.0"?>
<!DOCTYPE lolz [
 <!ENTITY lol "lol">
 <!ENTITY lol2 "&lol;&lol;&lol;&lol;&lol;&lol;&lol;&lol;&lol;&lol;">
 <!ENTITY lol3 "&lol2;&lol2;&lol2;&lol2;&lol2;&lol2;&lol2;&lol2;&lol2;&lol2;">
]>
<PHONEME text="&lol3;"/>"""
EXTERNAL = '<!DOCTYPE x [<!ENTITY secret SYSTEM "file:///etc/passwd">]><PHONEME text="&secret;"/>'
DECLARED = "document types and entity declarations are not allowed; expected <PHONEME"
BAD = [
    ("billion laughs", BOMB, f"f:2:1: {DECLARED}"),
    ("external entity", EXTERNAL, f"f:1:1: {DECLARED}"),
    ("external subset", '<A/>\n <!DOCTYPE x SYSTEM "http://example.org/x.dtd"><A/>', f"f:2:2: {DECLARED}"),
    ("entity alone", '<!ENTITY a "b"><A/>', f"f:1:1: {DECLARED}"),
    ("unknown entity", '\n<A t="&nbsp;"/>', "f:2:1: unknown entity '&nbsp;'; expected &amp;"),
    ("bare ampersand", '<A t="é & e"/>', "f:1:10: a bare '&'; expected &amp;"),
    ("bare angle", '<A t="a < b"/>', "f:1:9: a '<' inside an element; expected &lt;"),
    (
        "open value",
        '<A t="a/>\n<B t="b"/>',
        "f:2:1: a '<' inside an element; expected &lt;, or a closing quotation",
    ),
    ("open value at the end", '<A/>\n<B t="b/>', "f:2:1: not closed: a quotation mark or '/>' is missing"),
    ("no quotes", "<A t=1/>", "f:1:6: not well-formed (invalid token); expected e.g. <PHONEME"),
    ("twice", '<A t="1" t="2"/>', "f:1:10: duplicate attribute"),
    ("not closed", '<A/>\n  <B t="1">\n<!-- -->', "f:2:3: B is not closed; expected it to end with '/>'"),
    ("wrongly closed", "<A></B>", "f:1:1: A is not closed"),
    ("closed unopened", "<A/></B>", "f:1:7: mismatched tag"),
    ("the parser's own root", "<A/></_><_>", "f:1:9: junk after document element"),
    ("text", "<A/>\n hello <B/>", "f:2:2: 'hello' stands outside elements; expected <PHONEME"),
    ("text inside", "<A>hello</A>", "f:1:4: 'hello' stands outside elements"),
    ("text in CDATA", "<![CDATA[hello]]>", "'hello' stands outside elements"),
    ("nested", "<A>\n<B/></A>", "f:2:1: B stands inside A; expected it after"),
    ("containers nested", "<SCRIPT><SCRIPT/></SCRIPT>", "f:1:9: SCRIPT stands inside SCRIPT"),
    (
        "second declaration",
        '<A/><?xml version="1.0"?>',
        "f:1:5: XML or text declaration not at start of entity",
    ),
    (
        "encoding",
        '<?xml version="1.0" encoding="ISO-8859-1"?><A/>',
        "f:1: encoding 'ISO-8859-1' cannot be read; expected UTF-8",
    ),
    ("NUL", '<A t="\0"/>', "f:1:"),
    ("surrogate", '<A t="\udcff"/>', "f:1:"),
    ("invalid character", '<A t="&#0;"/>', "f:1:7: reference to invalid character number"),
    ("open comment", "<A/><!-- x", "f:1:5: unclosed token"),
    ("too large", " " * (MAX_BYTES + 1), "f: the markup is larger than 2,000,000 bytes; expected less"),
]


@pytest.mark.parametrize(("text", "message"), [row[1:] for row in BAD], ids=[row[0] for row in BAD])
def test_bad_markup_is_refused_with_its_place(text: str, message: str) -> None:
    with pytest.raises(InputError) as caught:
        read_elements(text, "f")
    assert message in str(caught.value)
    assert str(caught.value).isprintable()


@given(st.text("<>/&;\"'=!?-[]_ABx \n\r\0é", max_size=60))
def test_any_text_is_read_or_refused(text: str) -> None:
    refusals: list[InputError] = []
    try:
        read_elements(text, "f")
    except InputError as error:
        refusals.append(error)
    assert all(error.place is not None and str(error).isprintable() for error in refusals)


names = st.from_regex(r"[A-Za-z_][A-Za-z0-9_.-]{0,6}", fullmatch=True).filter(
    lambda n: n not in ("_", "SCRIPT")
)
# XML turns line ends and tabs in values into spaces unless they are written as references.
values = st.text(
    st.characters(exclude_categories=("Cc", "Cs"), exclude_characters="\ufffe\uffff"), max_size=8
)


@given(st.lists(st.tuples(names, st.dictionaries(names, values, max_size=3)), max_size=4))
def test_elements_are_read_back_as_written(elements: list[tuple[str, dict[str, str]]]) -> None:
    written = "\n".join(
        f"<{name} " + " ".join(f"{key}={quoteattr(value)}" for key, value in attributes.items()) + "/>"
        for name, attributes in elements
    )
    read = read_elements(written, "f")
    assert [(e.name, {a.name: a.value for a in e.attributes}) for e in read] == [
        (name.upper(), attributes) for name, attributes in elements
    ]
    assert [e.place for e in read] == [Place("f", line, 1) for line in range(1, len(elements) + 1)]


@given(st.text("\n é😀", max_size=20), st.text("\n ", min_size=1, max_size=5))
def test_places_point_at_what_is_written(before: str, gap: str) -> None:
    text = f"<!--{before}--> <AB{gap}x=\"é\n\"{gap}yy = '>'/>"
    (element,) = read_elements(text, "f")
    lines = text.split("\n")
    for place, start in ((element.place, "<AB"), *((a.place, a.name) for a in element.attributes)):
        assert place.line is not None
        assert place.column is not None
        assert lines[place.line - 1][place.column - 1 :].startswith(start)


def test_several_roots_prolog_comments_and_instructions() -> None:
    text = '<?xml version="1.0"\n encoding="UTF-8"?><!-- one --><a/>\r\n<?style x?>\r<B></B>'
    assert [(e.name, e.place.line, e.place.column) for e in read_elements(text, "f")] == [
        ("A", 2, 32),
        ("B", 4, 1),
    ]


def test_values_are_unescaped() -> None:
    (element,) = read_elements('<A t="&lt;b&gt; &amp; &quot;c&quot; &#233;&apos;\n\t" u=\'"\'/>', "f")
    assert [a.value for a in element.attributes] == ['<b> & "c" é\'  ', '"']


def test_a_container_may_stand_around_the_others() -> None:
    assert [e.name for e in read_elements("<script><a/><b/></script><c/>", "f")] == ["SCRIPT", "A", "B", "C"]
