# SPDX-License-Identifier: GPL-3.0-or-later
"""Coat, mix, transplant and peel. Each is one call of the engine."""

from math import degrees
from typing import Any, Dict, Generator, Tuple

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, StringProperty

from . import recipe_store, surface_result
from .arrays import object_arrays, world_matrix
from .background import EngineOperator, Work, warn
from .edit_request import check_object, has_mesh
from .engine import Outcome
from .errors import Refusal
from .preferences import chosen_engine
from .regions import Region, chosen_region, named_region
from .settings import PROFILES, settings_of

#: A generator that yields while it reads. It returns a step of a recipe, and a map from the files
#: in the step to object names.
Step = Generator[None, None, Tuple[Dict[str, Any], Dict[str, str]]]
REGIONS = [
    ("SELECTION", "Selection", "The selected vertices"),
    ("CURSOR", "3D Cursor", "What lies within a distance of the 3D cursor along the surface"),
    ("GROUP", "Vertex Group", "The vertices of a vertex group"),
    ("ALL", "All", "The whole mesh"),
]
_PLACES = [
    ("AUTO", "Fit", "The part's boundary is fitted to the hole"),
    ("WORLD", "Where It Is", "The part stays where it is in the scene"),
]


def length(name: str, description: str, default: float = 0.0) -> Any:
    return FloatProperty(name=name, description=description, default=default, min=0.0,
                         subtype="DISTANCE", precision=4)


class SurfaceOperator(EngineOperator):
    """Mixin. `step` is a generator whose value is the step for the active object's mesh."""

    region: EnumProperty(items=REGIONS, name="Where")
    radius: FloatProperty(name="Radius", min=1e-6, default=0.5, subtype="DISTANCE",
                          description="Around the 3D cursor")
    group: StringProperty(name="Vertex Group")

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return has_mesh(context) and not settings_of(context.object).is_live

    def step(self, context: bpy.types.Context, obj: bpy.types.Object) -> Step:
        raise NotImplementedError

    def target(self, context: bpy.types.Context, obj: bpy.types.Object) -> Region:
        return chosen_region(context, obj, self.region, self.radius, self.group, "Where")

    def prepare(self, context: bpy.types.Context) -> Generator[None, None, Work]:
        obj = check_object(context.object)
        engine = chosen_engine(context)
        self._name, self._matrix = obj.name, world_matrix(obj)
        if obj.mode not in ("OBJECT", "EDIT"):
            bpy.ops.object.mode_set(mode="OBJECT")
        self._mode = obj.mode
        self._step, self._objects = yield from self.step(context, obj)
        yield
        self._mesh = mesh = object_arrays(obj)
        yield
        others = yield from recipe_store.other_meshes(self._objects)
        if self._mode == "EDIT":
            bpy.ops.object.mode_set(mode="OBJECT")
        step = self._step
        return lambda progress: engine.run(mesh, [step], others, progress)

    def finish(self, context: bpy.types.Context, value: Outcome) -> None:
        obj = bpy.data.objects[self._name]
        notes = recipe_store.keeping_original(
            obj, lambda: surface_result.put(obj, self._mesh, value.mesh, self._matrix)
        )
        recipe_store.add(obj, [self._step], self._matrix, objects=self._objects)
        if self._mode == "EDIT":
            bpy.ops.object.mode_set(mode="EDIT")
        warn(self, [*value.warnings, *notes])

    def draw(self, _context: bpy.types.Context) -> None:
        layout = self.layout
        layout.use_property_split = True
        layout.prop(self, "region")
        if self.region == "CURSOR":
            layout.prop(self, "radius")
        elif self.region == "GROUP":
            layout.prop(self, "group")
        for name in self.shown:
            layout.prop(self, name)


def other_object(context: bpy.types.Context, name: str, what: str) -> bpy.types.Object:
    """Returns the object of this name, or the other selected object."""
    if name:
        other = bpy.data.objects.get(name)
        if other is None or other.type != "MESH":
            raise Refusal(f"{what} '{name}' is no mesh object of this file; choose another")
        return other
    others = [o for o in context.selected_objects if o.type == "MESH" and o != context.object]
    if len(others) != 1:
        raise Refusal(f"{what} is not chosen; select one other mesh object besides the active one")
    return others[0]


def source_region(obj: bpy.types.Object, group: str) -> Region:
    if not group:
        return {"all": True}
    return (yield from named_region(obj, group, "The source's region"))


def check_positive(value: float, what: str) -> float:
    if value <= 0.0:
        raise Refusal(f"{what} is 0; give the length below which a feature is detail")
    return value


class SourceOperator(SurfaceOperator):
    """Mixin for operators that take detail from another mesh object."""

    source: StringProperty(name="Source", description="Without it, the other selected mesh")
    source_group: StringProperty(name="Source Group", description="Where the detail is taken; all without it")
    detail_size: length("Detail Size", "Of the source: what is smaller is its detail", 0.1)
    find_disk: BoolProperty(name="Find Disks", default=True,
                            description="Take the largest disk in each region, if it is none itself")

    def disk_of(self, region: Dict[str, Any]) -> Dict[str, Any]:
        return {"disk_in": region} if self.find_disk else region

    def patch_of(self, source: bpy.types.Object) -> Region:
        return self.disk_of((yield from source_region(source, self.source_group)))

    def target_patch(self, context: bpy.types.Context, obj: bpy.types.Object) -> Region:
        return self.disk_of((yield from self.target(context, obj)))


class LAPWING_OT_coat(SourceOperator, bpy.types.Operator):
    bl_idname = "lapwing.coat"
    bl_label = "Coat"
    bl_description = "Puts the fine detail of the other selected mesh on a part of the active one"
    bl_options = {"REGISTER", "UNDO"}

    smooth_target: length("Smooth Target", "Features of the target smaller than this go first; 0 keeps them")
    amplitude: FloatProperty(name="Amplitude", default=1.0, description="Of the detail; negative engraves")
    shown = ("source", "source_group", "detail_size", "smooth_target", "amplitude", "find_disk")

    def step(self, context: bpy.types.Context, obj: bpy.types.Object) -> Step:
        other = other_object(context, self.source, "The source")
        step = {
            "op": "coat", "source": "source.ply",
            "source_patch": (yield from self.patch_of(other)),
            "target_patch": (yield from self.target_patch(context, obj)),
            "detail_size": check_positive(self.detail_size, "The detail size"),
            "smooth_target": self.smooth_target, "amplitude": self.amplitude,
        }
        return step, {"source.ply": other.name}


class LAPWING_OT_mix(SourceOperator, bpy.types.Operator):
    bl_idname = "lapwing.mix"
    bl_label = "Mix"
    bl_description = (
        "Mixes the detail of the other selected mesh with the active one's own, by distance from "
        "the 3D cursor"
    )
    bl_options = {"REGISTER", "UNDO"}

    own_detail_size: length("Own Detail Size", "Of the target: what is smaller is its detail", 0.1)
    own_radius: length("Own Within", "Within this distance of the 3D cursor the detail is the target's own", 0.1)
    width: length("Width", "Over which one detail goes over into the other; 0 is a step", 0.2)
    profile: EnumProperty(items=PROFILES, name="Profile")
    shown = ("source", "source_group", "detail_size", "own_detail_size", "own_radius", "width",
             "profile", "find_disk")

    def step(self, context: bpy.types.Context, obj: bpy.types.Object) -> Step:
        other = other_object(context, self.source, "The source")
        target = yield from self.target_patch(context, obj)
        patch = yield from self.patch_of(other)
        cursor = [float(x) for x in context.scene.cursor.location]
        own = check_positive(self.own_detail_size, "The own detail size")
        step = {
            "op": "mix", "target_patch": target,
            "sources": [
                {"mesh": "source.ply", "patch": patch,
                 "detail_size": check_positive(self.detail_size, "The detail size")},
                {"patch": target, "detail_size": own},
            ],
            "smooth_target": own, "profile": self.profile,
            "weight": {
                "distance_to": {"disk": {"near": cursor, "radius": self.own_radius}},
                "width": self.width,
            },
        }
        return step, {"source.ply": other.name}


class LAPWING_OT_transplant(SurfaceOperator, bpy.types.Operator):
    bl_idname = "lapwing.transplant"
    bl_label = "Transplant"
    bl_description = (
        "Puts the other selected mesh, or a part of it, in the place of a part of the active one"
    )
    bl_options = {"REGISTER", "UNDO"}

    part: StringProperty(name="Part", description="Without it, the other selected mesh")
    part_group: StringProperty(name="Part Group", description="What is cut from it; all without it")
    loop: IntProperty(name="Boundary", default=-1, min=-1,
                      description="Which boundary of the part is sewn on; -1 is the longest")
    place: EnumProperty(items=_PLACES, name="Place")
    turn: FloatProperty(name="Turn", subtype="ANGLE", description="About the hole's normal")
    scale: FloatProperty(name="Scale", default=1.0, min=0.001, description="Of the fitted part")
    snap: BoolProperty(name="Snap", description="Bring the part's boundary onto the surface")
    transition: length("Transition", "The detail goes over within this distance; 0 chooses what fits")
    shown = ("part", "part_group", "loop", "place", "turn", "scale", "snap", "transition")

    def step(self, context: bpy.types.Context, obj: bpy.types.Object) -> Step:
        other = other_object(context, self.part, "The part")
        part: Dict[str, Any] = {"mesh": "part.ply"}
        if self.part_group:
            part["region"] = yield from source_region(other, self.part_group)
        target = yield from self.target(context, obj)
        step: Dict[str, Any] = {"op": "transplant", "part": part, "target_region": target}
        if self.place == "AUTO":
            step["place"] = {"auto": {"rotate_degrees": degrees(self.turn), "scale": self.scale}}
        else:
            step["place"] = {"matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]}
            step["snap"] = self.snap
        if self.loop >= 0:
            step["loop"] = self.loop
        if self.transition > 0.0:
            step["transition"] = {"width": self.transition}
        return step, {"part.ply": other.name}


class LAPWING_OT_peel(SurfaceOperator, bpy.types.Operator):
    bl_idname = "lapwing.peel"
    bl_label = "Peel"
    bl_description = "Takes the fine detail off a part of the active mesh"
    bl_options = {"REGISTER", "UNDO"}

    detail_size: length("Detail Size", "Features smaller than this go", 0.1)
    shown = ("detail_size",)

    def step(self, context: bpy.types.Context, obj: bpy.types.Object) -> Step:
        size = check_positive(self.detail_size, "The detail size")
        region = yield from self.target(context, obj)
        return {"op": "peel", "region": region, "detail_size": size}, {}


CLASSES = (LAPWING_OT_coat, LAPWING_OT_mix, LAPWING_OT_transplant, LAPWING_OT_peel)
