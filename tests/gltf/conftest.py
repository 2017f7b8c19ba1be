"""Where things are says CTest, in the environment."""

import os
import shutil
import subprocess
from pathlib import Path

import pytest


def _require(found: bool, what: str) -> None:
    if found:
        return
    if os.environ.get("CI") == "true":
        pytest.fail(f"{what} is missing; tools/setup/install-packages --gltf brings it")
    pytest.skip(f"{what} is missing; tools/setup/install-packages --gltf brings it")


@pytest.fixture(scope="session")
def assimp() -> str:
    _require(shutil.which("assimp") is not None, "assimp")
    return "assimp"


@pytest.fixture(scope="session")
def validator(tmp_path_factory) -> Path:
    """A script that prints the validator's report of a file as JSON."""
    folder = Path(os.environ["LAPWING_NODE_MODULES"])
    _require(
        shutil.which("node") is not None and (folder / "gltf-validator").is_dir(), "gltf-validator"
    )
    script = tmp_path_factory.mktemp("validator") / "validate.js"
    script.write_text(
        "const fs = require('fs'), path = require('path');\n"
        f"const validator = require({str(folder / 'gltf-validator')!r});\n"
        "const file = process.argv[2];\n"
        "validator.validateBytes(new Uint8Array(fs.readFileSync(file)), {\n"
        "  externalResourceFunction: (uri) => new Promise((resolve, reject) => {\n"
        "    fs.readFile(path.resolve(path.dirname(file), decodeURIComponent(uri)),\n"
        "      (error, data) => error ? reject(error.toString()) : resolve(new Uint8Array(data)));\n"
        "  }), maxIssues: 0\n"
        "}).then((report) => console.log(JSON.stringify(report)),\n"
        "        (error) => { console.error(error); process.exit(1); });\n"
    )
    return script
