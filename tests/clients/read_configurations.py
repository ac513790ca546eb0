#!/usr/bin/env python3
"""Reads the configurations of docs/editors.md whose editors are not at hand, in what they are written in."""

import json
import re
import subprocess
import tomllib
import xml.etree.ElementTree
from pathlib import Path

import yaml


def configuration(language: str, heading: str) -> str:
    return subprocess.check_output([Path(__file__).with_name("configuration"), language, heading], text=True)


helix = tomllib.loads(configuration("toml", "## Helix"))
assert helix["language"][0]["language-servers"] == list(helix["language-server"])
assert helix["language"][0]["debugger"]["command"] == "isodap"
kate = json.loads(configuration("json", "## Kate"))["servers"]["isocnc"]
assert kate["command"] == ["isols"]
mode = xml.etree.ElementTree.fromstring(configuration("xml", "## Kate")).get("name")
assert kate["highlightingModeRegex"] == f"^{mode}$"
sublime = json.loads(configuration("json", "## Sublime Text"))["clients"]["isols"]
syntax = yaml.safe_load(configuration("yaml", "## Sublime Text"))
assert syntax["scope"] == sublime["selector"]
for rule in syntax["contexts"]["main"]:
    re.compile(rule["match"])
assert re.match(syntax["contexts"]["main"][1]["match"], "(a comment) G00")[0] == "(a comment)"
