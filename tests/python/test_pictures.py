# Pictures are those of `ringlet render`, in files and in arrays.
import signal
import struct
import zlib

import numpy as np
import pytest

import ringlet

SCENE = ('[groom]\ngenerate = "swatch"\ncolumns = 3\nrows = 2\nparticles = 20\nturns = 3\n[motion]\nkind = "shake"\n'
         '[simulation]\nframes = 3\nsteps_per_frame = 4\n[[body]]\nshape = "sphere"\nradius = 0.03\n'
         'position = [0, -0.05, 0.1]\n')
SMALL = {"size": (64, 48), "samples": 1, "hairs": 200}
OPTIONS = ["--size", "64x48", "--samples", "1", "--hairs", "200", "--quiet"]


def png(path):
    """The pixels of an 8-bit RGB file."""
    data, at, packed = path.read_bytes(), 8, b""
    while at < len(data):
        count, kind = struct.unpack(">I4s", data[at:at + 8])
        body, at = data[at + 8:at + 8 + count], at + 12 + count
        if kind == b"IHDR":
            width, height, depth, colours = struct.unpack(">IIBB", body[:10])
            assert (depth, colours) == (8, 2)
        packed += body if kind == b"IDAT" else b""
    rows = np.frombuffer(zlib.decompress(packed), np.uint8).reshape(height, 1 + 3 * width)
    image = np.zeros((height + 1, width + 1, 3), int)  # a row above and a column before
    for y, row in enumerate(rows, 1):
        for x in range(1, width + 1):
            left, up, corner = image[y, x - 1], image[y - 1, x], image[y - 1, x - 1]
            away = [np.abs(left + up - corner - each) for each in (left, up, corner)]
            paeth = np.where((away[0] <= away[1]) & (away[0] <= away[2]), left, np.where(away[1] <= away[2], up, corner))
            guess = (0 * left, left, up, (left + up) // 2, paeth)[row[0]]
            image[y, x] = (row[3 * x - 2:3 * x + 1] + guess) % 256
    return image[1:, 1:].astype(np.uint8)


@pytest.fixture
def animation(device, program):
    (program.folder / "scene.toml").write_text(SCENE)
    scene = ringlet.Scene.load(program.folder / "scene.toml")
    scene.run(device=device, folder=program.folder / "out", files=["hair.usda"])
    return scene, program.folder / "out/hair.usda"


def test_a_frame_is_that_of_the_program(device, program, animation):
    scene, path = animation
    program("render", path, "-o", "by_program.png", "--frames", "2:2", "--scene", "scene.toml", *OPTIONS, "--json")
    assert ringlet.render(path, program.folder / "by_module.png", frames=(2, 2), scene=scene, device=device,
                          **SMALL) == [program.folder / "by_module.png"]
    assert (program.folder / "by_module.png").read_bytes() == (program.folder / "by_program.png").read_bytes()
    image = ringlet.picture(path, frame=2, scene=scene, device=device, **SMALL)
    assert image.shape == (48, 64, 3) and image.dtype == np.uint8
    assert np.array_equal(image, png(program.folder / "by_program.png"))
    assert not np.array_equal(image, ringlet.picture(path, frame=3, scene=scene, device=device, **SMALL))


def test_every_number_of_a_look_changes_the_picture(device, animation):
    scene, path = animation
    plain = ringlet.picture(path, scene=scene, device=device, **SMALL)
    for values in ({"hairs": 0}, {"width": 0.001}, {"samples": 2}, {"colour": "black"}, {"azimuth": 80},
                   {"elevation": 40}, {"distance": 2}, {"bodies": False}, {"ground": True}, {"scene": None}):
        assert not np.array_equal(plain, ringlet.picture(path, **{"scene": scene, "device": device, **SMALL, **values})), values
    groom = ringlet.make_head(strands=100)
    assert not np.array_equal(ringlet.picture(groom, device=device, **SMALL),
                              ringlet.picture(groom, up="Z", device=device, **SMALL))


def test_a_folder_has_a_picture_a_frame(device, animation, tmp_path):
    scene, path = animation
    ringlet.render(path, tmp_path / "pictures", scene=scene, device=device, **SMALL)
    assert sorted(file.name for file in (tmp_path / "pictures").iterdir()) == [f"frame.{k:04}.png" for k in (1, 2, 3)]


def test_wrong_arguments_are_named(device, animation, tmp_path):
    _, path = animation
    for values, name in (({"frame": 0}, "frame"), ({"size": (0, 5)}, "size"), ({"samples": 5}, "samples"), ({"hairs": -1}, "hairs"),
                         ({"width": 0}, "width"), ({"colour": "plaid"}, "plaid"), ({"azimuth": float("nan")}, "azimuth"),
                         ({"elevation": 90}, "elevation"), ({"distance": 0}, "distance"), ({"up": "X"}, "axis 'X'")):
        with pytest.raises(ValueError, match=name):
            ringlet.picture(path, device=device, **{**SMALL, **values})
    with pytest.raises(ValueError, match="first <= last"):
        ringlet.render(path, tmp_path / "x.png", frames=(3, 2), device=device)
    with pytest.raises(ringlet.Error, match="has 3 frames; there is none of 4"):
        ringlet.picture(path, frame=4, device=device)
    with pytest.raises(ringlet.Error, match="missing.usda"):
        ringlet.picture(tmp_path / "missing.usda", device=device)
    with pytest.raises(TypeError):
        ringlet.picture(3, device=device)


def test_ctrl_c_ends_it_after_a_picture(device, animation, tmp_path):
    scene, path = animation
    handler = signal.signal(signal.SIGALRM, lambda number, frame: (_ for _ in ()).throw(KeyboardInterrupt))
    signal.setitimer(signal.ITIMER_REAL, 1e-3)  # long before the first picture
    try:
        with pytest.raises(KeyboardInterrupt):
            ringlet.render(path, tmp_path / "pictures", scene=scene, device=device, **SMALL)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, handler)
    assert len(list((tmp_path / "pictures").iterdir())) < 3
