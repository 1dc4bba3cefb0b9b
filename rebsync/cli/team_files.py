"""The files with which a repository begins to use rebsync: settings, hooks, CI."""

from __future__ import annotations

from rebsync import __version__

HOOKS = ".pre-commit-config.yaml"
GITHUB = ".github/workflows/rebsync.yml"
GITLAB = ".gitlab-ci.yml"

SETTINGS = """\
# Settings of {model}: docs/commands.md of rebsync has all of them.
{package}target = "{target}"
# license = "Apache-2.0"
# copyright = "2026 ACME Robotics"

# [[maintainers]]
# name = "Ada"
# email = "ada@example.org"
"""

# Of the repository `local`: what runs is the rebsync of whoever commits.
HOOK_ENTRIES = """\
  - repo: local
    hooks:
      - id: rebsync-check
        name: rebsync check
        entry: rebsync check
        language: system
        pass_filenames: false
        always_run: true
        stages: [pre-commit]
      - id: rebsync-verify
        name: rebsync check --verify
        entry: rebsync check --verify --max-time 60s
        language: system
        pass_filenames: false
        always_run: true
        stages: [pre-push]
"""

HOOKS_FILE = f"""\
default_install_hook_types: [pre-commit, pre-push]
repos:
{HOOK_ENTRIES}"""

WORKFLOW = f"""\
name: rebsync
on: [push, pull_request]
permissions:
  contents: read
  security-events: write
jobs:
  in-step:
    runs-on: ubuntu-latest
    steps:
      - uses: actions/checkout@v4
      - uses: actions/setup-python@v5
        with:
          python-version: "3.12"
      - run: pip install rebsync=={__version__}
      - name: Are models and code in step, and do the properties hold?
        run: rebsync check --verify --format sarif -o rebsync.sarif
      - uses: github/codeql-action/upload-sarif@v3
        if: ${{{{ !cancelled() && hashFiles('rebsync.sarif') != '' }}}}
        with:
          sarif_file: rebsync.sarif
          category: rebsync
"""

GITLAB_JOB = f"""\
rebsync:
  image: python:3.12-slim
  script:
    - pip install rebsync=={__version__}
    - rebsync check --verify --format junit -o rebsync.xml
  artifacts:
    when: always
    reports:
      junit: rebsync.xml
"""
