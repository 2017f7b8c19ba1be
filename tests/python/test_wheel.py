"""The module, installed by the lines of its page without a network."""

import os
import re
import sys

from conftest import run


def install_lines(source):
    """The commands under "Install" in the module's page, without the one that needs root."""
    page = (source / "tools" / "python" / "README.md").read_text()
    block = re.search(r"\*\*Install\.\*\*.*?\n\n((?:    .+\n)+)", page)
    assert block is not None
    lines = [line.strip() for line in block.group(1).splitlines()]
    assert lines[0] == "tools/setup/install-packages --python"
    return lines[1:]


def test_the_lines_of_the_page_install_it_offline(source, scan_file, tmp_path):
    # No index can be reached: what is not on this machine is an error.
    offline = {
        **{k: v for k, v in os.environ.items() if k != "PYTHONPATH"},
        "HOME": str(tmp_path),
        "PIP_NO_INDEX": "1",
        "PIP_DISABLE_PIP_VERSION_CHECK": "1",
    }
    lines = install_lines(source)
    assert len(lines) == 2
    run(["bash", "-e", "-c", "\n".join(lines)], cwd=source, env=offline)
    told = run(
        [tmp_path / "lapwing" / "bin" / "python", "-c",
         "import lapwing, os; print(lapwing.__file__);"
         "print(os.path.exists(os.path.join(os.path.dirname(lapwing.__file__), 'py.typed')));"
         "arm, hand = ({'disk': {'center': 969, 'radius': r}} for r in (72, 27));"
         f"V, F = lapwing.read({str(scan_file)!r});"
         "print(lapwing.deform(V, F, roi=arm, handles=[(hand, {'translate': [-5, 13, 2]})]))"],
        cwd=tmp_path, env=offline)
    assert str(tmp_path / "lapwing") in told and "True" in told and "Result" in told


def test_the_import_needs_neither_vulkan_nor_a_display(tmp_path):
    bare = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")}
    told = run([sys.executable, "-c",
                "import lapwing; maps = open('/proc/self/maps').read();"
                "print('vulkan' in maps, 'libX11' in maps)"],
               env=bare)
    assert told.split() == ["False", "False"]
