"""The comparison tells pictures apart."""

import numpy as np
import pytest
from compare import Layers, differences


@pytest.fixture
def picture() -> Layers:
    random = np.random.default_rng(1)
    return {
        "color": random.random((40, 60, 4)),
        "elementId": random.integers(-1, 9, (40, 60, 1)).astype(float),
        "cameraDepth": random.random((40, 60, 1)) * 10,
    }


def _changed(picture: Layers, name: str, change) -> Layers:
    layer = picture[name].copy()
    change(layer)
    return {**picture, name: layer}


def test_same(picture: Layers) -> None:
    assert differences(picture, picture) == []


def test_one_wrong_id_is_too_many(picture: Layers) -> None:
    def change(layer: np.ndarray) -> None:
        layer[3, 5] += 1

    (line,) = differences(_changed(picture, "elementId", change), picture)
    assert "column 5, row 3" in line


@pytest.mark.parametrize("name", ["color", "cameraDepth"])
def test_a_few_wrong_pixels_are_too_many(picture: Layers, name: str) -> None:
    def change(layer: np.ndarray) -> None:
        layer[:2, :2] += 0.05

    assert differences(_changed(picture, name, change), picture)


def test_one_silhouette_pixel_passes(picture: Layers) -> None:
    def change(layer: np.ndarray) -> None:
        layer[7, 7] = 1 - layer[7, 7]

    assert differences(_changed(picture, "color", change), picture) == []


def test_a_slightly_darker_picture_does_not_pass(picture: Layers) -> None:
    def change(layer: np.ndarray) -> None:
        layer *= 0.995

    assert differences(_changed(picture, "color", change), picture)


def test_not_a_number_does_not_pass(picture: Layers) -> None:
    def change(layer: np.ndarray) -> None:
        layer[0, 0] = np.nan

    assert differences(_changed(picture, "color", change), picture)


def test_missing_layer_and_other_size_do_not_pass(picture: Layers) -> None:
    assert differences({"color": picture["color"]}, picture)
    assert differences({**picture, "elementId": picture["elementId"][:, 1:]}, picture)
