"""What the packages hold of others: versions and licenses, from what is installed on the machine that builds."""

import base64
import json
import re
import subprocess
from dataclasses import dataclass, field
from pathlib import Path
from urllib.parse import quote, unquote

# The licenses that Debian's files of copyright only name.
COMMON_LICENSES = {
    "Apache-2.0": "Apache-2.0",
    "GPL-3.0-or-later": "GPL-3",
    "MPL-1.1": "MPL-1.1",
    "MPL-2.0": "MPL-2.0",
}
# Compile or bundle, and leave nothing of themselves in what they make.
BUILD_TOOLS = {"esbuild"}


class MissingComponent(Exception):
    pass


@dataclass(frozen=True)
class Component:
    name: str
    version: str
    license: str  # An SPDX expression.
    homepage: str
    purl: str  # Where it was taken from: the package of a registry or of Debian.
    text: str = field(repr=False)
    sha512: str = ""

    @property
    def id(self) -> str:
        return "SPDXRef-" + re.sub(r"[^A-Za-z0-9.-]+", "-", f"{self.name}-{unquote(self.purl.removeprefix('pkg:'))}")


@dataclass(frozen=True)
class Debian:
    """A library from a package of Debian."""

    name: str
    package: str
    license: str
    homepage: str
    version: str = ""  # Of a part of the package that has one of its own.

    def component(self) -> Component:
        version, architecture = installed(self.package)
        upstream = self.version or re.match(r"(?:\d+:)?([\d.]*\d)", version).group(1)
        purl = f"pkg:deb/debian/{quote(self.package)}@{quote(version)}?arch={architecture}"
        text = Path(f"/usr/share/doc/{self.package}/copyright").read_text(encoding="utf-8")
        return Component(self.name, upstream, self.license, self.homepage, purl, text)


def installed(package: str) -> tuple[str, str]:
    query = ["dpkg-query", "--show", "--showformat", "${db:Status-Status} ${Version} ${Architecture}", package]
    done = subprocess.run(query, capture_output=True, text=True, check=False)
    status, _, rest = done.stdout.partition(" ")
    if done.returncode != 0 or status != "installed":
        raise MissingComponent(f"the Debian package {package} is not installed: run scripts/setup")
    version, architecture = rest.split()
    return version, architecture


GCC = "GPL-3.0-or-later WITH GCC-exception-3.1"
LLVM = "Apache-2.0 WITH LLVM-exception"
LIBRARIES = [
    Debian("nlohmann-json", "nlohmann-json3-dev", "MIT", "https://json.nlohmann.me/"),
    Debian("Eigen", "libeigen3-dev", "MPL-2.0 AND BSD-3-Clause", "https://eigen.tuxfamily.org/"),
    Debian("CLI11", "libcli11-dev", "BSD-3-Clause", "https://github.com/CLIUtils/CLI11"),
    Debian("fmt", "libfmt-dev", "MIT", "https://fmt.dev/"),
    Debian("stb", "libstb-dev", "MIT OR Unlicense", "https://github.com/nothings/stb"),
    Debian("fast_float", "libfast-float-dev", "MIT OR Apache-2.0", "https://github.com/fastfloat/fast_float"),
]
COMPILERS = {
    "linux-x64": "g++",
    "linux-arm64": "aarch64-linux-gnu-g++",
    "windows-x64": "x86_64-w64-mingw32-g++-posix",
}
EMSCRIPTEN_LIBRARIES = Path("/usr/share/emscripten/system/lib")


def runtime(platform: str) -> list[Debian]:
    """What the compiler links of its own."""
    if platform == "web":
        musl = (EMSCRIPTEN_LIBRARIES / "libc/musl/VERSION").read_text(encoding="utf-8").strip()
        header = (EMSCRIPTEN_LIBRARIES / "libcxx/include/__config").read_text(encoding="utf-8")
        llvm = int(re.search(r"_LIBCPP_VERSION (\d+)", header).group(1))
        return [
            Debian("Emscripten", "emscripten", "MIT OR NCSA", "https://emscripten.org/"),
            Debian("musl", "emscripten", "MIT", "https://musl.libc.org/", musl),
            Debian("libc++, libc++abi, libunwind, compiler-rt", "emscripten", LLVM, "https://libcxx.llvm.org/",
                   f"{llvm // 1000}.{llvm // 100 % 10}.{llvm % 100}"),
        ]  # fmt: skip
    compiler = COMPILERS[platform]
    libraries = [
        Debian(name, package_with(compiler, f"{name}.a"), GCC, "https://gcc.gnu.org/") for name in ("libstdc++", "libgcc")
    ]
    if platform == "windows-x64":
        package = package_with(compiler, "libwinpthread.a")
        parts = "ZPL-2.1 AND MIT AND BSD-3-Clause"
        libraries.append(Debian("mingw-w64 with winpthreads", package, parts, "https://www.mingw-w64.org/"))
    return libraries


def package_with(compiler: str, library: str) -> str:
    """The Debian package of a library that a compiler links."""
    try:
        file = subprocess.run([compiler, f"-print-file-name={library}"], capture_output=True, text=True, check=True).stdout
        query = ["dpkg-query", "--search", str(Path(file.strip()).resolve())]
        found = subprocess.run(query, capture_output=True, text=True, check=True).stdout
    except (OSError, subprocess.CalledProcessError) as error:
        raise MissingComponent(f"no Debian package has the {library} of {compiler}: run scripts/setup") from error
    return found.partition(":")[0]


SITE = [
    Debian("Material for MkDocs", "mkdocs-material", "MIT AND MPL-1.1 AND Apache-2.0 AND CC-BY-4.0",
           "https://squidfunk.github.io/mkdocs-material/"),
]  # fmt: skip


def of_npm(package: Path) -> list[Component]:
    """What is bundled of the packages that package-lock.json of a folder names, and that npm has installed there."""
    lock = json.loads((package / "package-lock.json").read_text(encoding="utf-8"))
    return [
        npm_component(package / path, entry)
        for path, entry in lock["packages"].items()
        if path and not entry.get("dev") and not entry.get("optional") and name_of(path) not in BUILD_TOOLS
    ]


def name_of(path: str) -> str:
    return path.rpartition("node_modules/")[2]


def npm_component(folder: Path, entry: dict) -> Component:
    name = name_of(folder.as_posix())
    texts = sorted(path for path in folder.glob("*") if path.name.lower().startswith(("license", "licence")))
    if not texts:
        raise MissingComponent(f"{name} states no license in {folder}")
    algorithm, _, digest = entry["integrity"].partition("-")
    return Component(
        name,
        entry["version"],
        entry["license"],
        f"https://www.npmjs.com/package/{name}",
        f"pkg:npm/{quote(name, safe='/')}@{entry['version']}",
        "\n".join(path.read_text(encoding="utf-8") for path in texts),
        base64.b64decode(digest).hex() if algorithm == "sha512" else "",
    )


def of_programs(platform: str, source: Path) -> list[Component]:
    """What the programs for a platform hold: isorun holds the page of the toolpath, too."""
    libraries = [each.component() for each in [*LIBRARIES, *runtime(platform)]]
    return libraries + of_npm(source / "toolpath-view")


def of_extension(platform: str, source: Path) -> list[Component]:
    return of_programs(platform, source) + of_npm(source / "vscode-extension")


def of_site() -> list[Component]:
    return [each.component() for each in SITE]


def unique(components: list[Component]) -> list[Component]:
    return list({each.id: each for each in components}.values())


def notices(components: list[Component]) -> str:
    """The licenses of all of them; a text that several share stands there once."""
    components = unique(components)
    lines = [
        "This package holds the software of others that is listed here. Its licenses follow.",
        "Questo pacchetto contiene il software di terzi elencato qui. Seguono le licenze.",
        "",
        *dict.fromkeys(f"- {each.name} {each.version}: {each.license}; {each.homepage}" for each in components),
    ]
    texts: dict[str, list[str]] = {}
    for each in components:
        texts.setdefault(each.text.strip(), []).append(f"{each.name} {each.version}")
    for identifier, file in COMMON_LICENSES.items():
        if any(identifier in each.license.split() for each in components):
            text = Path("/usr/share/common-licenses", file).read_text(encoding="utf-8")
            texts.setdefault(text.strip("\n"), []).append(identifier)
    for text, titles in texts.items():
        lines += ["", "=" * 100, "; ".join(dict.fromkeys(titles)), "=" * 100, "", text]
    return "\n".join(lines) + "\n"
