"""An option of the image tests: make the baselines instead of comparing with them."""

import pytest


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--update-baselines", action="store_true", help="render baselines anew")


@pytest.fixture
def update_baselines(request: pytest.FixtureRequest) -> bool:
    """True if baselines are to be made."""
    return request.config.getoption("--update-baselines")
