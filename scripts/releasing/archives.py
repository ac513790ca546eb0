"""Archives whose bytes depend on nothing but the files in them and how hard they are compressed: sorted, all of one time and one owner."""

import gzip
import io
import tarfile
import time
import zipfile
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class File:
    data: bytes
    executable: bool = False

    @property
    def mode(self) -> int:
        return 0o755 if self.executable else 0o644


Files = dict[str, File]  # By their names in the archive, with "/" between folders.


def of_folder(folder: Path) -> Files:
    return {
        path.relative_to(folder).as_posix(): File(path.read_bytes(), bool(path.stat().st_mode & 0o100))
        for path in folder.rglob("*")
        if path.is_file()
    }


def of_tar(path: Path) -> Files:
    with tarfile.open(path) as archive:
        return {
            member.name.removeprefix("./"): File(archive.extractfile(member).read(), bool(member.mode & 0o100))
            for member in archive
            if member.isfile()
        }


def of_zip(path: Path) -> Files:
    with zipfile.ZipFile(path) as archive:
        return {
            member.filename: File(archive.read(member), bool(member.external_attr >> 16 & 0o100))
            for member in archive.infolist()
            if not member.is_dir()
        }


def below(folder: str, files: Files) -> Files:
    return {f"{folder}/{name}": file for name, file in files.items()}


def write_tar_gz(path: Path, files: Files, seconds: int, level: int) -> None:
    """`seconds` since 1970 is the time of each member, and `level` that of compression, from 1 to 9."""
    tar = io.BytesIO()
    with tarfile.open(fileobj=tar, mode="w", format=tarfile.USTAR_FORMAT) as archive:
        for name, file in sorted(files.items()):
            member = tarfile.TarInfo(name)
            member.size = len(file.data)
            member.mode = file.mode
            member.mtime = seconds
            member.uname = member.gname = "root"
            archive.addfile(member, io.BytesIO(file.data))
    path.write_bytes(gzip.compress(tar.getvalue(), level, mtime=0))


def write_zip(path: Path, files: Files, seconds: int, level: int) -> None:
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, file in sorted(files.items()):
            member = zipfile.ZipInfo(name, time.gmtime(seconds)[:6])
            member.create_system = 3  # The mode is one of POSIX, whatever system writes.
            member.external_attr = (0o100000 | file.mode) << 16
            member.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(member, file.data, compresslevel=level)
