"""The wheel, built and installed without a network."""

import os
import sys

from conftest import run


def test_the_wheel_installs_in_a_clean_environment_offline(source, tmp_path):
    # No index can be reached: what is not on this machine is an error.
    offline = {
        **{k: v for k, v in os.environ.items() if k != "PYTHONPATH"},
        "PIP_NO_INDEX": "1",
        "PIP_DISABLE_PIP_VERSION_CHECK": "1",
    }
    run([sys.executable, "-m", "pip", "wheel", "--no-build-isolation", "--no-deps", "-w", tmp_path,
         source / "tools" / "python"],
        env=offline)
    (wheel,) = tmp_path.glob("lapwing-*.whl")
    # numpy comes from the system: it cannot be downloaded either.
    run([sys.executable, "-m", "venv", "--system-site-packages", tmp_path / "clean"], env=offline)
    python = tmp_path / "clean" / "bin" / "python"
    run([python, "-m", "pip", "install", "--no-deps", wheel], env=offline)
    told = run(
        [python, "-c",
         "import lapwing, os; print(lapwing.__file__);"
         "print(os.path.exists(os.path.join(os.path.dirname(lapwing.__file__), 'py.typed')));"
         "tube = lapwing.shape('tube');"
         "print(lapwing.deform(tube, belt=[0, 1, 2], handles=[([900], {'translate': [0, 0, 1]})]))"],
        cwd=tmp_path, env=offline)
    assert str(tmp_path / "clean") in told and "True" in told and "Result" in told


def test_the_import_needs_neither_vulkan_nor_a_display(tmp_path):
    bare = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")}
    told = run([sys.executable, "-c",
                "import lapwing; maps = open('/proc/self/maps').read();"
                "print('vulkan' in maps, 'libX11' in maps)"],
               env=bare)
    assert told.split() == ["False", "False"]
