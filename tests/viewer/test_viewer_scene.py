"""The bridge from MuJoCo to Viser: everything visible is there, where MuJoCo has it, in MuJoCo's colours.

Viser keeps poses as float32.
"""

from __future__ import annotations

from collections.abc import Iterator

import mujoco
import numpy as np
import pytest
import viser
from trimesh.visual import TextureVisuals
from trimesh.visual.material import PBRMaterial

from sldr_core.envs import make_envs
from worker.viewer.dress import dress, geom_rgba, is_visible
from worker.viewer.page import open_page
from worker.viewer.scene import Look, SceneView
from worker.viewer.shapes import geom_mesh, linear_from_srgb
from worker.viewer.skeleton import Kinematics

SHAPES = """
<mujoco>
  <worldbody>
    <geom name="plane" type="plane" size="1 2 .1"/>
    <body name="a/b" pos="1 0 0">
      <geom name="sphere" type="sphere" size=".1"/>
      <geom name="capsule" type="capsule" size=".1 .2"/>
      <geom name="cylinder" type="cylinder" size=".1 .2"/>
      <geom name="ellipsoid" type="ellipsoid" size=".1 .2 .3"/>
      <geom name="box" type="box" size=".1 .2 .3" rgba="1 0 0 .5"/>
      <geom name="hidden" type="box" size=".1 .2 .3" group="3"/>
      <geom name="clear" type="box" size=".1 .2 .3" rgba="1 1 1 0"/>
    </body>
  </worldbody>
</mujoco>
"""

HALF_SIZES = {
    "plane": (1, 2, 0),
    "sphere": (0.1, 0.1, 0.1),
    "capsule": (0.1, 0.1, 0.3),
    "cylinder": (0.1, 0.1, 0.2),
    "ellipsoid": (0.1, 0.2, 0.3),
    "box": (0.1, 0.2, 0.3),
}


def placed(nodes: dict[int, viser.FrameHandle], prefix: str) -> dict[int, tuple[np.ndarray, np.ndarray]]:
    """Return where a page shows bodies, position and quaternion: a node is placed in that above it."""
    found: dict[str, tuple[np.ndarray, np.ndarray]] = {prefix: (np.zeros(3), np.array([1.0, 0.0, 0.0, 0.0]))}
    for node in nodes.values():
        (position, quaternion), offset, place = found[node.name.rpartition("/")[0]], np.empty(3), np.empty(4)
        mujoco.mju_rotVecQuat(offset, np.asarray(node.position), quaternion)
        mujoco.mju_mulQuat(place, quaternion, np.asarray(node.wxyz))
        found[node.name] = position + offset, place
    return {body: found[node.name] for body, node in nodes.items()}


@pytest.fixture(scope="module")
def server() -> Iterator[viser.ViserServer]:
    server = open_page()
    yield server
    server.stop()


@pytest.fixture(scope="module")
def shapes() -> mujoco.MjModel:
    return mujoco.MjModel.from_xml_string(SHAPES)


@pytest.mark.parametrize("phase", ["manipulation", "locomotion"])
def test_every_visible_geom_has_a_node_and_no_other(server, phase):
    model = make_envs("FetchPush", phase=phase).model
    view = SceneView(server, model, prefix=f"/{phase}")
    visible = {geom for geom in range(model.ngeom) if is_visible(model, geom)}
    assert set(view.geom_nodes) == visible
    assert model.geom("object0").id in visible
    assert {model.body(b).name for b in view.skeleton.nodes} >= {"object0", "table0"}


def test_the_mocap_lines_are_left_out():
    model = make_envs("FetchPush").model
    handles = [g for g in range(model.ngeom) if model.body(model.geom_bodyid[g]).name == "robot0:mocap"]
    assert handles
    assert not any(is_visible(model, geom) for geom in handles)


def test_hidden_groups_and_transparent_geoms_are_left_out(shapes):
    assert not is_visible(shapes, shapes.geom("hidden").id)
    assert not is_visible(shapes, shapes.geom("clear").id)


@pytest.mark.parametrize("name", HALF_SIZES)
def test_a_shape_is_as_large_as_mujoco_has_it(shapes, name):
    mesh = geom_mesh(shapes, shapes.geom(name).id)
    assert mesh.bounds[1] == pytest.approx(HALF_SIZES[name], abs=1e-3)
    assert mesh.bounds[0] == pytest.approx(-np.asarray(HALF_SIZES[name]), abs=1e-3)


def test_a_mesh_has_the_vertices_and_normals_of_the_model():
    model = make_envs("FetchPush").model
    geom = model.geom("robot0:head_tilt_link").id
    asset = int(model.geom_dataid[geom])
    start, count = model.mesh_faceadr[asset], model.mesh_facenum[asset]
    vertices = model.mesh_vert[model.mesh_vertadr[asset] :][model.mesh_face[start : start + count]]
    normals = model.mesh_normal[model.mesh_normaladr[asset] :][model.mesh_facenormal[start : start + count]]
    mesh = geom_mesh(model, geom)
    assert np.allclose(mesh.vertices[mesh.faces], vertices, atol=1e-6)
    assert np.allclose(mesh.vertex_normals[mesh.faces], normals, atol=1e-5)


def test_a_geom_takes_its_material_s_colour_where_it_has_none_of_its_own():
    model = make_envs("FetchPush").model
    assert geom_rgba(model, model.geom("object0").id)[:3] == pytest.approx((0.2, 0.2, 0.2))
    assert geom_rgba(model, model.geom("robot0:estop_link").id)[:3] == pytest.approx((0.8, 0, 0))


def test_half_grey_on_the_display_is_a_fifth_of_the_light():
    assert linear_from_srgb(np.array([0.0, 0.5, 1.0])) == pytest.approx([0.0, 0.2140, 1.0], abs=1e-4)


def test_a_plain_object_is_dressed_in_the_cube_map_and_the_model_is_left_alone():
    model = make_envs("FetchPush").model
    geom = model.geom("object0").id
    dressed, plain = (geom_mesh(scene, geom).visual for scene in (dress(model), model))
    assert isinstance(dressed, TextureVisuals)
    assert isinstance(plain, TextureVisuals)
    assert isinstance(dressed.material, PBRMaterial)
    assert isinstance(plain.material, PBRMaterial)
    assert dressed.material.baseColorTexture is not None
    assert plain.material.baseColorTexture is None


def test_shown_poses_equal_mujoco_s(server):
    envs = make_envs("FetchPush", seed=4)
    view = SceneView(server, envs.model, prefix="/poses")
    kinematics = Kinematics(envs.model)
    view.show(kinematics.poses(envs.qpos[0]))
    rng = np.random.default_rng(0)
    for _ in range(5):
        envs.step(rng.uniform(-1, 1, (1, envs.action_size)))
    view.show(kinematics.poses(envs.qpos[0]))
    data = mujoco.MjData(envs.model)
    data.qpos[:] = envs.qpos[0]
    mujoco.mj_forward(envs.model, data)
    for body, (position, quaternion) in placed(view.skeleton.nodes, "/poses").items():
        assert position == pytest.approx(data.xpos[body], abs=5e-5)
        assert quaternion == pytest.approx(data.xquat[body] * np.sign(quaternion @ data.xquat[body]), abs=5e-5)
    for geom, node in view.geom_nodes.items():
        assert node.position == pytest.approx(envs.model.geom_pos[geom])
        assert node.wxyz == pytest.approx(envs.model.geom_quat[geom])


def test_two_scenes_on_one_page_do_not_meet(server, shapes):
    one = SceneView(server, shapes, prefix="/one")
    ghost = SceneView(server, shapes, prefix="/ghost", look=Look(opacity=0.3))
    assert not {node.name for node in one.geom_nodes.values()} & {node.name for node in ghost.geom_nodes.values()}
    assert all(node.name.startswith("/ghost/") for node in ghost.geom_nodes.values())


def test_a_joint_between_two_positions_takes_the_short_way_round():
    model = mujoco.MjModel.from_xml_string(
        "<mujoco><worldbody><body><freejoint/><geom size='.1'/></body></worldbody></mujoco>"
    )
    here, there = np.array([0.0, 0, 0, 1, 0, 0, 0]), np.array([2.0, 0, 0, -np.cos(0.2), 0, 0, -np.sin(0.2)])
    middle = Kinematics(model).poses_between(here, there, 0.5)
    assert middle.pos[1] == pytest.approx([1.0, 0, 0])
    assert middle.quat[1] == pytest.approx([np.cos(0.1), 0, 0, np.sin(0.1)], abs=1e-6)


def test_a_limb_keeps_its_length_between_two_positions():
    model = make_envs("HandBlockRotate").model
    there = model.qpos0.copy()
    there[:24] += 0.8
    kinematics = Kinematics(model)
    lengths = [
        np.linalg.norm(poses.pos[model.body("robot0:ffdistal").id] - poses.pos[model.body("robot0:ffmiddle").id])
        for poses in (kinematics.poses(model.qpos0), kinematics.poses_between(model.qpos0, there, 0.5))
    ]
    assert lengths[0] == pytest.approx(lengths[1], abs=1e-12)


def test_a_body_that_stands_still_is_not_sent_again(server, monkeypatch):
    model = make_envs("HandBlockRotate").model
    view, kinematics = SceneView(server, model, prefix="/still"), Kinematics(model)
    qpos = model.qpos0.copy()
    view.show(kinematics.poses(qpos))
    sent = []
    monkeypatch.setattr(server.scene, "_queue_scene_message", sent.append)
    view.show(kinematics.poses(qpos))
    assert sent == []
    qpos[model.joint("robot0:FFJ3").qposadr] += 0.3  # the whole finger goes with its knuckle
    view.show(kinematics.poses(qpos))
    assert [type(message).__name__ for message in sent] == ["SetOrientationMessage"]


def test_the_goal_turns_green_when_reached(server):
    view = SceneView(server, make_envs("FetchPush").model, prefix="/goal")
    [(goal, red)] = view._goals
    view.show_goals((1.0, 2.0, 3.0), reached=True)
    assert tuple(goal.position) == (1.0, 2.0, 3.0)
    assert tuple(goal.color) != red


def test_of_a_demonstration_only_the_objects_are_drawn(server):
    model = make_envs("FetchPush", phase="locomotion").model
    ghost = SceneView(server, model, prefix="/objects", look=Look(objects_only=True))
    assert {model.body(model.geom_bodyid[geom]).name for geom in ghost.geom_nodes} == {"object0"}


def test_the_page_listens_on_this_machine_alone_and_opens_no_tunnel(server):
    assert server.get_host() == "127.0.0.1"
    assert server.request_share_url() is None
