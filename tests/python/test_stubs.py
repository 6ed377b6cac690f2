# The type stubs are those of the module, everything in it has a docstring, and the page of the module names everything.
import ast
import inspect
import re
from pathlib import Path

import pytest

import ringlet

STUBS = Path(ringlet.__file__).parent / "ringlet-stubs/__init__.pyi"
TREE = ast.parse(STUBS.read_text())
# What pybind11 and Python give every class.
COMMON = {"__module__", "__doc__", "__hash__", "__dict__", "__weakref__", "__getattr__", "__setattr__"}
NOT_CONSTRUCTIBLE = {"Body", "DeviceSummary", "Frame", "RunResult", "Scene"}


def stub_classes():
    return {node.name: node for node in TREE.body if isinstance(node, ast.ClassDef)}


def stub_functions(body):
    return {node.name: node for node in body if isinstance(node, ast.FunctionDef)}


def is_a(node, decorator):
    return any(isinstance(d, ast.Name) and d.id == decorator for d in node.decorator_list)


def parameters_of_stub(node):
    """[(name, default or None, whether it is by keyword only)] without self."""
    arguments = node.args
    positional = arguments.posonlyargs + arguments.args
    defaults = [None] * (len(positional) - len(arguments.defaults)) + arguments.defaults
    found = [(a.arg, d, False) for a, d in zip(positional, defaults)]
    found += [(a.arg, d, True) for a, d in zip(arguments.kwonlyargs, arguments.kw_defaults)]
    if found and found[0][0] == "self":
        found = found[1:]
    plain = [(name, default and ast.literal_eval(default), keyword) for name, default, keyword in found]
    return plain + ([("**" + arguments.kwarg.arg, None, False)] if arguments.kwarg else [])


def parameters_of_module(function):
    """The same from the first line of what pybind11 writes."""
    line = function.__doc__.split("\n")[0]
    inside = re.fullmatch(r"\w+\((.*)\) -> .*", line).group(1)
    inside = re.sub(r": (?:[\w.]+(?:\[[^\]]*\]+)?)", "", inside)
    inside = inside.replace("**kwargs", "**kwargs")
    tree = ast.parse(f"def f({inside}): pass").body[0]
    found = parameters_of_stub(tree)
    return [entry for entry in found if entry[0] != "self"]


def returns_of(function):
    return function.__doc__.split("\n")[0].rsplit("-> ", 1)[1]


def members_of(cls):
    members = {}
    for name, member in vars(cls).items():
        if name in COMMON or (name == "__init__" and cls.__name__ in NOT_CONSTRUCTIBLE):
            continue
        if isinstance(member, property):
            members[name] = "property" if member.fset else "read-only"
        else:
            members[name] = "static" if isinstance(member, staticmethod) else "method"
    return members


def members_of_stub(node):
    members = {}
    for part in node.body:
        if isinstance(part, ast.AnnAssign):
            members[part.target.id] = "property"
        elif isinstance(part, ast.FunctionDef):
            members[part.name] = ("read-only" if is_a(part, "property") else
                                  "static" if is_a(part, "staticmethod") else "method")
    return {name: kind for name, kind in members.items() if name not in COMMON}


CLASSES = {name: cls for name, cls in vars(ringlet).items() if inspect.isclass(cls) and name != "Error"}
FUNCTIONS = {name: value for name, value in vars(ringlet).items()
             if callable(value) and not inspect.isclass(value) and not name.startswith("_")}


def test_the_same_names():
    assert set(CLASSES) | {"Error"} == set(stub_classes())
    assert set(FUNCTIONS) == set(stub_functions(TREE.body))


@pytest.mark.parametrize("name", CLASSES)
def test_the_same_members(name):
    assert members_of_stub(stub_classes()[name]) == members_of(CLASSES[name])


@pytest.mark.parametrize("name", FUNCTIONS)
def test_functions_have_the_same_parameters(name):
    assert parameters_of_stub(stub_functions(TREE.body)[name]) == parameters_of_module(FUNCTIONS[name])


@pytest.mark.parametrize("name", CLASSES)
def test_methods_have_the_same_parameters(name):
    stubs = stub_functions(stub_classes()[name].body)
    for member, kind in members_of(CLASSES[name]).items():
        if kind in ("static", "method"):
            assert parameters_of_stub(stubs[member]) == parameters_of_module(getattr(CLASSES[name], member)), member


def test_classes_return_what_the_stubs_say():
    simple = {"int", "str", "bool", "float", "None"} | {"ringlet." + name for name in CLASSES}
    for name, cls in CLASSES.items():
        stubs = stub_functions(stub_classes()[name].body)
        for member, kind in members_of(cls).items():
            if kind in ("static", "method") and returns_of(getattr(cls, member)) in simple:
                said = returns_of(getattr(cls, member)).replace("ringlet.", "")
                assert ast.unparse(stubs[member].returns) == said, f"{name}.{member}"


def test_numbers_have_the_attributes_that_the_tables_have():
    rows = {row["key"] for row in ringlet.Settings.fields()}
    for cls, table in ((ringlet.Settings, ""), (ringlet.ContactSettings, "contacts."), (ringlet.AirSettings, "air."),
                       (ringlet.GoalSettings, "goal.")):
        own = {key[len(table):] for key in rows if key.startswith(table) and "." not in key[len(table):]}
        changing = {name for name, kind in members_of(cls).items() if kind == "property"}
        assert changing - {"contacts", "air", "goal"} == own
    own = {row["key"] for row in ringlet.Material.parameters() if "." not in row["key"]}
    assert {name for name, kind in members_of(ringlet.Material).items() if kind == "property"} == own


def documented():
    yield "ringlet", ringlet.__doc__
    yield "Error", ringlet.Error.__doc__
    for name, function in FUNCTIONS.items():
        yield name, function.__doc__.partition("\n\n")[2]
    for name, cls in CLASSES.items():
        yield name, cls.__doc__
        for member, kind in members_of(cls).items():
            value = vars(cls)[member]
            if kind in ("property", "read-only"):
                yield f"{name}.{member}", value.__doc__
            else:
                yield f"{name}.{member}", getattr(cls, member).__doc__.partition("\n\n")[2]


@pytest.mark.parametrize("name, doc", documented(), ids=lambda v: v if len(v or "") < 40 else "doc")
def test_everything_has_a_docstring(name, doc):
    assert doc and len(doc.strip()) >= 3, name
    assert doc.strip()[-1] in ".)]:" and "  " not in doc.replace("\n    ", "\n").strip().split("\n\n")[0], name


def public_names():
    return [name for name in dir(ringlet) if not name.startswith("_")]


def test_the_page_names_everything():
    page = (Path(__file__).parents[2] / "docs/python.md").read_text()
    table = page[page.index("## Everything"):page.index("## Errors")]
    named = set(re.findall(r"`(\w+)`", table))
    assert set(public_names()) <= named
    assert named - set(public_names()) <= set(), "there is no such name"


# Parameters that are arrays, by what their stubs say, and where their shapes are told: with the function or its class.
def test_help_shows_the_shapes_of_arrays():
    shape = re.compile(r"\((?:particles|points|strands|steps|keys|bodies|frames|nodes|nz|z|count|rows|n|\d)[^()]*,[^()]*\)")
    lacking = []
    for owner, body, holder in [("", TREE.body, ringlet)] + [
            (name, node.body, getattr(ringlet, name)) for name, node in stub_classes().items()]:
        for name, node in stub_functions(body).items():
            arguments = node.args.args + node.args.kwonlyargs
            arrays = [a.arg for a in arguments if a.annotation and "_PointsIn" in ast.unparse(a.annotation)]
            told = getattr(holder, name).__doc__ + (holder.__doc__ if owner else "")
            if arrays and not shape.search(told):
                lacking.append(f"{owner}.{name}: {', '.join(arrays)}")
    assert lacking == []


def test_reprs_say_what_things_are():
    classes = [value for value in vars(ringlet).values() if inspect.isclass(value) and value is not ringlet.Error]
    assert len(classes) > 20
    assert [c.__name__ for c in classes if "__repr__" not in vars(c)] == []
