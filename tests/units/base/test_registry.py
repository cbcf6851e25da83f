"""Registries: built-in things, plug-ins, refusals."""

from pathlib import Path

import pytest

from vibroacoustics.base import registry as registries
from vibroacoustics.base.errors import ParameterError, PluginError
from vibroacoustics.base.plugin_file import load_plugin
from vibroacoustics.base.registry import Origin, Registry, register


class Fruit:
    """What the registry of these tests holds."""

    name = ""


class Apple(Fruit):
    name = "apple"
    position = 2.0


class Pear(Fruit):
    name = "pear"
    position = 1.0


@pytest.fixture
def fruits(monkeypatch: pytest.MonkeyPatch) -> Registry[type[Fruit]]:
    """A registry with two built-in things, known to `register` for one test only."""
    monkeypatch.setattr(registries, "_REGISTRIES", [])
    registry: Registry[type[Fruit]] = Registry("fruit", Fruit, "name", "base", "no.such.group")
    registry.add(Apple)
    registry.add(Pear)
    return registry


def test_order_is_by_position_then_name(fruits: Registry[type[Fruit]]) -> None:
    class Banana(Fruit):
        name = "banana"

    fruits.add(Banana)
    assert list(fruits) == ["pear", "apple", "banana"]


def test_unknown_name_tells_which_one_comes_close(fruits: Registry[type[Fruit]]) -> None:
    with pytest.raises(ParameterError, match=r"fruit aple: unknown, did you mean apple\? allowed"):
        fruits["aple"]
    with pytest.raises(ParameterError, match="fruit xyz: unknown; allowed pear, apple"):
        fruits["xyz"]


def test_clash_with_a_built_in_name_is_refused(fruits: Registry[type[Fruit]]) -> None:
    class Other(Fruit):
        name = "apple"

    with pytest.raises(PluginError, match=r"mine.py: fruit apple: is built in; choose another"):
        fruits.add(Other, Origin("mine.py", "", "0"))
    fruits.add(Apple)  # the same thing again is no clash


def test_register_finds_registry_and_origin(fruits: Registry[type[Fruit]]) -> None:
    @register
    class Cherry(Fruit):
        name = "cherry"

    assert fruits["cherry"] is Cherry
    origin = fruits.origin("cherry")
    assert origin is not None
    assert origin.file == Path(__file__).name
    assert len(origin.sha256) == 64
    assert fruits.origin("apple") is None
    assert registries.plugins() == {"fruit cherry": origin._asdict()}
    with pytest.raises(PluginError, match="is none of fruit"):
        register(3)


def test_thing_without_name_is_refused(fruits: Registry[type[Fruit]]) -> None:
    with pytest.raises(PluginError, match="a fruit needs a text `name`"):
        register(type("Nameless", (Fruit,), {}))


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("raise ValueError('no')", "ValueError: no"),
        ("1 +", "SyntaxError"),
        ("import no_such_module", "ModuleNotFoundError"),
    ],
)
def test_broken_plugin_is_one_line(tmp_path: Path, content: str, message: str) -> None:
    file = tmp_path / "mine.py"
    file.write_text(content)
    with pytest.raises(PluginError, match=rf"mine.py: mine.py, line 1: {message}") as caught:
        load_plugin(file)
    assert "\n" not in str(caught.value)


def test_missing_plugin_is_refused(tmp_path: Path) -> None:
    with pytest.raises(PluginError, match="no such file"):
        load_plugin(tmp_path / "none.py")


def test_plugin_is_run_once(tmp_path: Path) -> None:
    trace = tmp_path / "trace"
    file = tmp_path / "mine.py"
    file.write_text(f"open({str(trace)!r}, 'a').write('x')\n")
    load_plugin(file)
    load_plugin(file)
    assert trace.read_text() == "x"
