"""Commands that start nodes, called in the test process."""

import sys

import pytest
from forked import fork_nodes, open_process


@pytest.fixture
def nodes(monkeypatch):
    """The nodes that a command in this process has started, as forks; they end with the test."""
    opened = []

    def open_node(*words, **options):
        opened.append(open_process(*words, **options))
        return opened[-1]

    fork_nodes(monkeypatch, open_node)
    yield opened
    for node in opened:
        if node.poll() is None:
            node.kill()


@pytest.fixture
def call_in_domain(nodes, domain, monkeypatch, capsys):
    """call_in_domain(name, main, *words): status, output and lines of errors; no node is left."""
    monkeypatch.setenv("ROS_DOMAIN_ID", str(domain))

    def call_one(name: str, main, *words: str) -> tuple[int, str, list[str]]:
        monkeypatch.setattr(sys, "argv", [name, *words, "--domain", str(domain)])
        status = main()
        assert all(node.poll() is not None for node in nodes)
        printed = capsys.readouterr()
        return status, printed.out, printed.err.splitlines()

    return call_one
