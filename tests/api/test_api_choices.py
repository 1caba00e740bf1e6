"""What the launch form is made from."""

from __future__ import annotations

import io
import os

from live_api import Service, problem_fields
from PIL import Image


def test_choices_hold_tasks_methods_presets_and_the_schema_of_a_config(unused_service: Service):
    choices = unused_service.get("/api/choices")
    assert "FetchPush" in [task["name"] for task in choices["tasks"]]
    phases = {method["name"]: method["phases"] for method in choices["methods"]}
    assert list(phases) == ["ddpg", "her", "cher", "her-dense", "ddpg-sldr", "her-rnd", "her-sldr"]
    assert [name for name in phases if "locomotion" in phases[name]] == ["ddpg", "her", "cher"]
    assert "quick" in [preset["name"] for preset in choices["presets"]]
    assert "loop" in choices["config_schema"]["properties"]


def test_choices_are_compressed_for_browsers(unused_service: Service):
    answer = unused_service.client.get("/api/choices", headers={"accept-encoding": "gzip"})
    assert answer.headers["content-encoding"] == "gzip"


def test_a_picture_is_sent_once_it_is_drawn(service: Service):
    missing = service.client.get("/api/tasks/FetchPush/picture")
    service.settings.pictures_directory.mkdir(parents=True)
    (service.settings.pictures_directory / "FetchPush.png").write_bytes(b"\x89PNG")
    drawn = service.client.get("/api/tasks/FetchPush/picture")
    assert missing.status_code == 404
    assert "not drawn yet" in missing.json()["problems"][0]["message"]
    assert (drawn.content, drawn.headers["content-type"]) == (b"\x89PNG", "image/png")


def test_lists_get_a_small_form_of_a_picture(service: Service):
    directory = service.settings.pictures_directory
    directory.mkdir(parents=True)
    path = directory / "FetchPush.png"
    address = "/api/tasks/FetchPush/thumbnail"
    assert service.client.get(address).status_code == 404
    Image.radial_gradient("L").convert("RGB").resize((800, 500)).save(path)
    small = service.client.get(address)
    assert (small.headers["content-type"], len(small.content) < 6_000) == ("image/webp", True)
    assert Image.open(io.BytesIO(small.content)).size == (168, 105)
    Image.new("RGB", (800, 500)).save(path)
    os.utime(path, (2_000_000_000, 2_000_000_000))
    assert service.client.get(address).content != small.content, "the picture was drawn anew"
    assert [file.name for file in directory.iterdir() if file.name.startswith(".")] == []


def test_an_unknown_task_has_no_picture(unused_service: Service):
    answer = unused_service.client.get("/api/tasks/..%2f..%2fsecret/picture")
    assert answer.status_code == 404


def test_defaults_are_the_whole_config_of_a_launch(unused_service: Service):
    params = {"task": "FetchPush", "phase": "locomotion", "method": "her", "preset": "smoke"}
    assert unused_service.get("/api/defaults", params=params)["loop"]["batch_size"] == 64


def test_defaults_for_what_does_not_exist_name_the_field(unused_service: Service):
    params = {"task": "FetchPush", "phase": "manipulation", "method": "her", "preset": "huge"}
    answer = unused_service.client.get("/api/defaults", params=params)
    assert answer.status_code == 422
    assert problem_fields(answer) == ["preset"]


def test_defaults_without_a_task_name_the_field(unused_service: Service):
    answer = unused_service.client.get(
        "/api/defaults", params={"phase": "manipulation", "method": "her", "preset": "quick"}
    )
    assert problem_fields(answer) == ["task"]
