"""The list of what each file of a release holds, as SPDX 2.3 (https://spdx.github.io/spdx-spec/v2.3/)."""

import json
import re
import time
from dataclasses import dataclass

from .components import Component


@dataclass(frozen=True)
class Artifact:
    """A file of the release."""

    name: str
    sha256: str
    components: list[Component]
    holds: list[str]  # Names of other files of the release that it holds, unpacked or not.

    @property
    def id(self) -> str:
        return "SPDXRef-" + re.sub(r"[^A-Za-z0-9.-]+", "-", f"release-{self.name}")


def document(version: str, commit: str, seconds: int, artifacts: list[Artifact]) -> str:
    components = {each.id: each for artifact in artifacts for each in artifact.components}
    ids = {artifact.name: artifact.id for artifact in artifacts}
    relationships = []
    for artifact in artifacts:
        relationships.append(relationship("SPDXRef-DOCUMENT", "DESCRIBES", artifact.id))
        for each in sorted({each.id for each in artifact.components}):
            relationships.append(relationship(artifact.id, "CONTAINS", each))
        for name in artifact.holds:
            relationships.append(relationship(artifact.id, "CONTAINS", ids[name]))
    return json.dumps(
        {
            "spdxVersion": "SPDX-2.3",
            "dataLicense": "CC0-1.0",
            "SPDXID": "SPDXRef-DOCUMENT",
            "name": f"isocnc-{version}",
            "documentNamespace": f"https://isocnc.invalid/spdx/isocnc-{version}-{commit}",
            "creationInfo": {
                "created": time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime(seconds)),
                "creators": [f"Tool: scripts/release-{version}"],
            },
            "packages": [artifact_package(each, version) for each in artifacts]
            + [component_package(each) for _, each in sorted(components.items())],
            "relationships": relationships,
        },
        indent=2,
    ) + "\n"


def relationship(subject: str, kind: str, other: str) -> dict:
    return {"spdxElementId": subject, "relationshipType": kind, "relatedSpdxElement": other}


def artifact_package(artifact: Artifact, version: str) -> dict:
    return {
        "SPDXID": artifact.id,
        "name": artifact.name,
        "packageFileName": artifact.name,
        "versionInfo": version,
        "downloadLocation": "NOASSERTION",
        "filesAnalyzed": False,
        "checksums": [{"algorithm": "SHA256", "checksumValue": artifact.sha256}],
        "licenseConcluded": "NOASSERTION",  # Of all that it holds; the relationships name the parts.
        "licenseDeclared": "MIT",
        "copyrightText": "NOASSERTION",
    }


def component_package(component: Component) -> dict:
    package = {
        "SPDXID": component.id,
        "name": component.name,
        "versionInfo": component.version,
        "downloadLocation": "NOASSERTION",
        "homepage": component.homepage,
        "filesAnalyzed": False,
        "licenseConcluded": "NOASSERTION",
        "licenseDeclared": component.license,
        "copyrightText": "NOASSERTION",
        "externalRefs": [
            {"referenceCategory": "PACKAGE-MANAGER", "referenceType": "purl", "referenceLocator": component.purl}
        ],
    }
    if component.sha512:
        package["checksums"] = [{"algorithm": "SHA512", "checksumValue": component.sha512}]
    return package
