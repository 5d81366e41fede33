"""Write constraints.txt and a lock for each of MORE: versions and hashes, no index address."""

import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

ROOT = Path(__file__).parent.parent
BUILD = ["hatchling", "editables", "codespell"]
MORE = ("bench", "docs")  # dependency groups that are installed on top, when they are needed


def compile_to(target: Path, requirements: list[str], *, hashes: bool) -> None:
    """Resolve requirements and write them down."""
    with tempfile.TemporaryDirectory() as folder:
        source = Path(folder) / "requirements.in"
        source.write_text("\n".join(requirements), encoding="utf-8")
        options = ["--no-header", "--no-emit-index-url", "--no-emit-trusted-host"]
        options += ["--no-emit-find-links", "--no-annotate"]
        # An extra that a package asks for counts as pinned only where the lock names it.
        options += ["--allow-unsafe", "--no-strip-extras", "--quiet"]
        options += ["--generate-hashes"] if hashes else []
        subprocess.run(
            [sys.executable, "-m", "piptools", "compile", *options, "-o", str(target), str(source)],
            check=True,
        )


def main() -> None:
    """Resolve what the project, its tests and its checks need; then each of the other groups."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    groups = project["dependency-groups"]
    base = [*project["project"]["dependencies"], *groups["test"], *groups["lint"], *BUILD]
    compile_to(ROOT / "constraints.txt", base, hashes=True)
    pinned = (ROOT / "constraints.txt").read_text(encoding="utf-8").splitlines()
    versions = [line.split(" ")[0] for line in pinned if "==" in line]
    for name in MORE:
        compile_to(ROOT / f"constraints-{name}.txt", [*versions, *groups[name]], hashes=True)


if __name__ == "__main__":
    main()
