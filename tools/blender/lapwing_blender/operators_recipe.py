# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators for recipes of objects: replay on another object, export for `lapwing run`, forget."""

import json
import os
from typing import Any, Dict, Generator, List, Set

import bpy
from bpy.props import BoolProperty, IntProperty, StringProperty
from bpy_extras.io_utils import ExportHelper

from . import live_mesh, recipe_store, surface_result
from .arrays import object_arrays, to_local, world_matrix
from .background import EngineOperator, Work, finished, warn
from .edit_request import check_object, has_mesh
from .engine import Outcome
from .errors import Refusal, Refusing
from .operators_surface import other_object
from .ply import write_ply
from .preferences import chosen_engine
from .settings import settings_of

_LAST = IntProperty(
    name="Edit", default=-1, min=-1,
    description="The recipe goes up to this edit of the object, counted from 0; -1 is the last",
)


class LAPWING_OT_replay(EngineOperator, bpy.types.Operator):
    bl_idname = "lapwing.replay"
    bl_label = "Replay"
    bl_description = (
        "Makes the edits of the other selected mesh object on the active one, which has the same "
        "vertices"
    )
    bl_options = {"REGISTER", "UNDO"}

    source: StringProperty(name="Recipe Of", description="Without it, the other selected mesh")
    edit: _LAST
    as_key: BoolProperty(name="As Shape Key", description="In a shape key, with the mesh as it was")
    key_name: StringProperty(name="Name", default="Lapwing")

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return has_mesh(context) and not settings_of(context.object).is_live

    def prepare(self, context: bpy.types.Context) -> Generator[None, None, Work]:
        obj = check_object(context.object)
        engine = chosen_engine(context)
        source = other_object(context, self.source, "The object with the recipe")
        edits = recipe_store.chain(source, self.edit)
        start = settings_of(source).original or source.data
        if obj.mode != "OBJECT":
            bpy.ops.object.mode_set(mode="OBJECT")
        if len(start.vertices) != len(obj.data.vertices):
            raise Refusal(
                f"'{obj.name}' has {len(obj.data.vertices)} vertices and the recipe of "
                f"'{source.name}' is for {len(start.vertices)}; replay it on a mesh with the same vertices"
            )
        self._name, self._matrix = obj.name, world_matrix(obj)
        self._steps, self._objects = recipe_store.steps_at(edits, self._matrix)
        yield
        self._mesh = object_arrays(obj)
        yield
        others = yield from recipe_store.other_meshes(self._objects)
        mesh, steps = self._mesh, self._steps
        return lambda progress: engine.run(mesh, steps, others, progress)

    def finish(self, context: bpy.types.Context, value: Outcome) -> None:
        obj = bpy.data.objects[self._name]
        if self.as_key:
            if not value.mesh.has_faces_of(self._mesh):
                raise Refusal(
                    "The edit makes other faces, which a shape key cannot hold; replay it into "
                    "the mesh"
                )
            local = to_local(self._matrix, value.mesh.vertices)
            key, notes = live_mesh.keep_as_key(obj, local, self.key_name or "Lapwing"), []
        else:
            key = ""
            notes = recipe_store.keeping_original(
                obj, lambda: surface_result.put(obj, self._mesh, value.mesh, self._matrix)
            )
        recipe_store.add(obj, self._steps, self._matrix, key=key, objects=self._objects)
        warn(self, [*value.warnings, *notes])


class LAPWING_OT_export_recipe(Refusing, bpy.types.Operator, ExportHelper):
    bl_idname = "lapwing.export_recipe"
    bl_label = "Export Recipe"
    bl_description = "Writes the recipe and the meshes that it needs, for `lapwing run`"
    filename_ext = ".json"

    filter_glob: StringProperty(default="*.json", options={"HIDDEN"})
    edit: _LAST

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return has_mesh(context)

    def act(self, context: bpy.types.Context) -> None:
        obj = context.object
        edits = recipe_store.chain(obj, self.edit)
        matrix = recipe_store.matrix_of_edit(edits[0])
        steps, objects = recipe_store.steps_at(edits, matrix)
        path = bpy.path.abspath(self.filepath)
        folder, stem = os.path.dirname(path), os.path.splitext(os.path.basename(path))[0]
        names = {file: f"{stem}-{file}" for file in objects}
        recipe = {
            "lapwing": 1, "mesh": f"{stem}.ply",
            "steps": [recipe_store.with_files(step, names) for step in steps],
            "save": f"{stem}-edited.ply",
        }
        try:
            write_ply(os.path.join(folder, f"{stem}.ply"), recipe_store.start_mesh(obj, matrix))
            for file, mesh in finished(recipe_store.other_meshes(objects)).items():
                write_ply(os.path.join(folder, names[file]), mesh)
            with open(path, "w", encoding="utf-8") as file:
                json.dump(recipe, file, indent=1)
        except OSError as error:
            raise Refusal(
                f"{error.filename} cannot be written ({error.strerror}); choose another folder"
            ) from error
        self.report({"INFO"}, f"Written: {path}")


class LAPWING_OT_forget_recipe(bpy.types.Operator):
    bl_idname = "lapwing.forget_recipe"
    bl_label = "Forget Recipe"
    bl_description = (
        "Frees the copy of the original mesh; the edits can no longer be replayed or exported"
    )
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return has_mesh(context) and recipe_store.PROPERTY in context.object

    def execute(self, context: bpy.types.Context) -> Set[str]:
        recipe_store.forget(context.object)
        return {"FINISHED"}


CLASSES = (LAPWING_OT_replay, LAPWING_OT_export_recipe, LAPWING_OT_forget_recipe)
