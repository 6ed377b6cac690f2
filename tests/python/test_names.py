# Materials and settings: numbers by name, checked by the library's tables.
import copy
import math

import pytest

import ringlet

# Of each table: how to make one, and the rows that describe its numbers.
NUMBERS = [(ringlet.Material, row) for row in ringlet.Material.parameters() if not row["key"].startswith("profile.")]
SETTINGS = [row for row in ringlet.Settings.fields() if row["low"] is not None]


def is_whole(value):
    return isinstance(value, int) and not isinstance(value, bool)


@pytest.mark.parametrize("row", [row for _, row in NUMBERS], ids=lambda row: row["key"])
def test_every_number_of_a_material_has_its_range(row):
    material = ringlet.Material()
    key = row["key"]
    assert key in material and material[key] == row["default"]
    for inside in (row["low"], row["high"], row["usual_low"]):
        material[key] = int(inside) if is_whole(row["default"]) else inside
        assert material[key] == inside
    step = 1 if is_whole(row["default"]) else abs(row["high"]) * 1e-3
    for outside in (row["low"] - 1, row["high"] + step):
        with pytest.raises(ValueError, match=key):
            material[key] = int(outside) if is_whole(row["default"]) else outside
    for wrong in ("5", [1], True):
        with pytest.raises(TypeError, match=key):
            material[key] = wrong
    if is_whole(row["default"]):
        with pytest.raises(TypeError):
            material[key] = 1.5
    else:
        for number in (math.nan, math.inf, -math.inf):
            with pytest.raises(ValueError):
                material[key] = number
    if row["default"] is None:
        material[key] = None
        assert material[key] is None
    else:
        with pytest.raises(TypeError):
            material[key] = None


@pytest.mark.parametrize("row", SETTINGS, ids=lambda row: row["key"])
def test_every_setting_has_its_range(row):
    settings = ringlet.Settings()
    key = row["key"]
    table, _, name = key.rpartition(".")
    owner = getattr(settings, table) if table else settings
    assert key in settings and settings[key] == row["default"] == getattr(owner, name)
    is_vector = isinstance(row["default"], tuple)
    whole = is_whole(row["default"]) or key in ("contacts.iterations",)
    for inside in (row["low"], row["high"]):
        value = (inside, 0, inside) if is_vector else int(inside) if whole else inside
        settings[key] = value
        assert settings[key] == value == getattr(owner, name)
        setattr(owner, name, value)
    for outside in (row["low"] - 1, row["high"] + max(1, abs(row["high"]) * 1e-3), math.nan, math.inf):
        if whole and not math.isfinite(outside):
            continue
        value = (0, outside, 0) if is_vector else int(outside) if whole else outside
        with pytest.raises(ValueError, match=key):
            settings[key] = value
        with pytest.raises(ValueError, match=key):
            setattr(owner, name, value)
    for wrong in ("5", {}, True):
        with pytest.raises(TypeError, match=key):
            settings[key] = wrong
    if is_vector:
        with pytest.raises(ValueError, match="three numbers"):
            settings[key] = (1, 2)


def test_words_and_switches():
    settings = ringlet.Settings(integrator="point_jacobi", contacts={"on": True, "method": "volume"})
    assert (settings.integrator, settings.contacts.on, settings.contacts.method) == ("point_jacobi", True, "volume")
    settings.contacts.taper = "time"
    assert settings["contacts.taper"] == "time"
    with pytest.raises(ValueError, match="did you mean jacobi"):
        settings.integrator = "jacoby"
    with pytest.raises(ValueError, match="did you mean distance"):
        settings.contacts.taper = "distanse"
    for wrong in (1, 0, "on", None):
        with pytest.raises(TypeError, match="True or False"):
            settings.contacts.on = wrong
    with pytest.raises(TypeError, match="takes a word"):
        settings.contacts.taper = 3


def test_unknown_names_are_told_with_the_nearest():
    material, settings = ringlet.Material(), ringlet.Settings()
    with pytest.raises(KeyError, match="did you mean bend_stiffness"):
        material["bend_stifness"]
    with pytest.raises(KeyError, match="did you mean variation.core_stiffness"):
        material["variation.core_stifness"] = 1
    with pytest.raises(AttributeError, match="did you mean core_stiffness"):
        material.core_stifness = 3
    with pytest.raises(AttributeError, match="did you mean core_stiffness"):
        material.core_stifness
    with pytest.raises(TypeError, match="did you mean dials.hold"):
        ringlet.Material(**{"dials.hoold": 1})
    with pytest.raises(KeyError, match="did you mean gravity"):
        settings["gravty"]
    with pytest.raises(AttributeError, match="did you mean steps_per_frame"):
        settings.steps_per_fame = 3
    with pytest.raises(AttributeError, match="did you mean friction"):
        settings.contacts.frction = 3
    with pytest.raises(TypeError, match="did you mean air.wind"):
        ringlet.Settings(air={"wint": (1, 0, 0)})
    with pytest.raises(TypeError, match="did you mean fps"):
        ringlet.Settings(fsp=3)
    with pytest.raises(ValueError, match="did you mean coil"):
        ringlet.Material.preset("coill")


def test_all_numbers_of_a_call_are_set_or_none():
    settings = ringlet.Settings()
    with pytest.raises(ValueError):
        settings.contacts = {"friction": 0.5, "spacing": 7}
    assert settings.contacts.friction == 0
    settings.air = ringlet.AirSettings(on=True, wind=(1, 2, 3))
    assert settings.air.wind == (1, 2, 3) and settings["air.on"] is True


def test_parts_of_settings_are_theirs_and_keep_them_alive():
    contacts = ringlet.Settings(contacts={"friction": 0.25}).contacts
    junk = [ringlet.Settings(contacts={"friction": 0.75}) for _ in range(100)]
    assert contacts.friction == 0.25
    settings = ringlet.Settings()
    settings.contacts.friction = 0.5
    assert settings["contacts.friction"] == 0.5
    other = settings.copy()
    other.contacts.friction = 0.125
    assert settings.contacts.friction == 0.5 and other != settings and settings == settings.copy()
    del junk


def test_presets_files_and_profiles(tmp_path):
    assert list(ringlet.Material.presets()) == ["straight", "wavy", "loose_curl", "ringlet", "coil"]
    material = ringlet.Material.preset("coil", bend_stiffness=8, **{"dials.hold": 1.5, "variation.seed": 9})
    material["profile.bend_stiffness"] = [(0, 1), (1, 0.5)]
    material.write(tmp_path / "coil.toml")
    again = ringlet.Material.load(tmp_path / "coil.toml")
    assert again == material and again["profile.bend_stiffness"] == [(0, 1), (1, 0.5)]
    assert dict(again) == {key: material[key] for key in material.keys()}
    assert material != ringlet.Material() and material.copy() == material
    assert ringlet.Material(**dict(material)) == material
    for wrong in ([(0, 1), (0, 1)], [(0.5, 1), (0.25, 1)], [(2, 1)], [(0, 1e9)]):
        with pytest.raises(ValueError, match="profile.bend_stiffness"):
            material["profile.bend_stiffness"] = wrong
    material["profile.bend_stiffness"] = []
    assert material["profile.bend_stiffness"] == []
    (tmp_path / "broken.toml").write_text("bend_stiffness = 'x'\n")
    with pytest.raises(ringlet.Error, match="broken.toml.*1"):
        ringlet.Material.load(tmp_path / "broken.toml")


def test_repr_shows_what_is_not_the_default():
    assert repr(ringlet.Material(bend_stiffness=8)) == "<ringlet.Material: bend_stiffness=8.0>"
    assert repr(ringlet.Settings(air={"on": True})) == "<ringlet.Settings: air.on=True>"
    assert "default" in repr(ringlet.Settings())


def test_they_can_be_copied_by_pythons_own_means():
    settings = ringlet.Settings(steps_per_frame=3)
    with pytest.raises(TypeError):
        hash(settings)
    assert copy.copy(settings) == settings and copy.deepcopy(settings) == settings
    assert copy.deepcopy(ringlet.Material(bend_stiffness=3)).bend_stiffness == 3


# What tells how to mend a file says it in Python's own words, not as options of the command.
def test_warnings_name_arguments_of_python(tmp_path):
    (tmp_path / "lying.obj").write_text("v 0 0 0\nv 0 0 -20\nv 1 0 0\nv 1 0 -20\nl 1 2\nl 3 4\n")
    (warning,) = ringlet.read_groom(tmp_path / "lying.obj").warnings
    assert 'takes up="Z"' in warning
    assert ringlet.read_groom(tmp_path / "lying.obj", up="Z").warnings == []
    (tmp_path / "points.ply").write_text("ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
                                         "property float z\nend_header\n0 0 0\n0 -9 0\n")
    with pytest.raises(ringlet.Error, match="say how many: points_per_strand") as refused:
        ringlet.read_groom(tmp_path / "points.ply")
    (tmp_path / "turned.usda").write_text(
        '#usda 1.0\n(\n    upAxis = "Z"\n)\ndef BasisCurves "h"\n{\n    int[] curveVertexCounts = [2]\n'
        '    point3f[] points = [(0, 0, 0), (0, 0, -9)]\n    uniform token type = "linear"\n}\n')
    turned = ringlet.read_groom(tmp_path / "turned.usda").warnings
    assert any('up="Z" keeps its axes' in sentence for sentence in turned)
    tiny = ringlet.make_curl(metres_per_unit=1e-5)
    placed = ringlet.check_placement(tiny.with_points(tiny.points / 1000))
    assert any("metres_per_unit" in sentence for sentence in placed)
    (tmp_path / "small.bvh").write_text(
        "HIERARCHY\nROOT Hips\n{\nOFFSET 0 0 0\nCHANNELS 1 Zrotation\nJOINT Head\n{\nOFFSET 0 9 0\nCHANNELS 1 Zrotation\n"
        "End Site\n{\nOFFSET 0 1 0\n}\n}\n}\nMOTION\nFrames: 2\nFrame Time: 1\n0 0\n1 0\n")
    motion = ringlet.Motion.load(tmp_path / "small.bvh", metres_per_unit=1).warnings
    assert any("metres_per_unit=" in sentence for sentence in motion)
    scene = ringlet.Scene.parse('[groom]\nfile = "lying.obj"\n', tmp_path).warnings
    assert any('takes up = "Z" of [groom]' in sentence for sentence in scene)
    for sentence in [warning, str(refused.value), *turned, *placed, *motion, *scene]:
        assert "--" not in sentence.replace("`ringlet info FILE --fix OUT`", "").replace("`ringlet info --fix`", "")
