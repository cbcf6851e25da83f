"""Tables written as TOML come back equal."""

import tomllib

from hypothesis import given
from hypothesis import strategies as st

from vibroacoustics.study.toml_text import toml_text

PLAIN = st.text(st.characters(exclude_categories=["Cs"]), max_size=8)
VALUES = st.one_of(
    PLAIN,
    st.booleans(),
    st.integers(-(2**53), 2**53),
    st.floats(allow_nan=False, allow_infinity=False),
)
QUANTITIES = st.fixed_dictionaries({"value": VALUES, "source": PLAIN})
TABLES = st.recursive(
    st.dictionaries(PLAIN, VALUES | QUANTITIES | st.lists(VALUES, max_size=3), max_size=4),
    lambda inner: st.dictionaries(PLAIN, inner, max_size=3),
    max_leaves=6,
)


@given(TABLES)
def test_comes_back_equal(content: dict[str, object]) -> None:
    assert tomllib.loads(toml_text(content)) == content
