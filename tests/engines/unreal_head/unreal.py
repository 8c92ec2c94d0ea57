"""Stands in for the module `unreal` of Unreal's editor: runs a script of a plugin and prints as JSON what it made.

    python3 -B unreal.py SCRIPTS 'import dermis_head; dermis_head.build()'

SCRIPTS is the plugin's Content/Python. Classes and enumerators have the names that the script uses; nothing says whether the editor has
them. glTF is imported as Interchange does it: x, z, y of the file's axes, metres to centimetres.
"""

import json
import os
import struct
import sys


class Kind(type):
    def __getattr__(cls, name):
        if name.startswith("__"):
            raise AttributeError(name)
        return name  # an enumerator


class Thing(metaclass=Kind):
    """Any object: its properties, of which those that nothing has set are objects too."""

    def __init__(self, *_arguments):
        self.properties = {}

    def set_editor_property(self, name, value):
        self.properties[name] = value

    def get_editor_property(self, name):
        return self.properties.setdefault(name, Thing())

    def written(self):
        if self in editor.assets.values():
            return {"asset": next(path for path, asset in editor.assets.items() if asset is self)}
        if self in editor.nodes:
            return {"node": editor.nodes.index(self)}
        return dict({name: written(value) for name, value in self.properties.items()}, kind=type(self).__name__)


def written(value):
    if isinstance(value, (list, tuple)):
        return [written(one) for one in value]
    return value.written() if isinstance(value, Thing) else value


class Vector(Thing):
    def __init__(self, x=0.0, y=0.0, z=0.0):
        self.x, self.y, self.z = x, y, z

    def __sub__(self, other):
        return Vector(self.x - other.x, self.y - other.y, self.z - other.z)

    def written(self):
        return [self.x, self.y, self.z]


class LinearColor(Thing):
    def __init__(self, r, g, b, a):
        self.numbers = [r, g, b, a]

    def written(self):
        return self.numbers


class Rotator(Thing):
    def __init__(self, forward, up):
        super().__init__()
        self.properties = {"forward": forward, "up": up}


class MathLibrary:
    @staticmethod
    def make_rot_from_x(forward):
        return Rotator(forward, Vector(0.0, 0.0, 1.0))

    make_rot_from_xz = Rotator


class Editor:
    """What the editor has: assets by their paths, actors, and the nodes of all materials."""

    def __init__(self):
        self.assets, self.actors, self.nodes, self.links = {}, [], [], []

    def asset(self, path, kind, **properties):
        made = globals().get(kind, None) or __getattr__(kind)
        self.assets[path] = made()
        self.assets[path].properties.update(properties)
        return self.assets[path]


editor = Editor()


class EditorAssetLibrary:
    @staticmethod
    def load_asset(path):
        if path not in editor.assets and path.startswith("/Engine/"):
            editor.asset(path, "Texture2D")
        return editor.assets.get(path)

    @staticmethod
    def does_asset_exist(path):
        return path in editor.assets

    @staticmethod
    def delete_asset(path):
        del editor.assets[path]

    @staticmethod
    def save_loaded_asset(_asset):
        return True


class Box:
    def __init__(self, low, high):
        self.min, self.max = low, high


class StaticMesh(Thing):
    def get_bounding_box(self):
        return self.box

    def set_material(self, slot, material):
        self.properties["static_materials"][slot].properties["material_interface"] = material


def import_glb(path, filename):
    with open(filename, "rb") as file:
        length = struct.unpack("<I", file.read(20)[12:16])[0]
        document = json.loads(file.read(length))
    mesh = editor.asset(path, "StaticMesh", file=filename)
    corners = {"min": [], "max": []}
    slots = []
    for primitive in document["meshes"][0]["primitives"]:
        for end, found in corners.items():
            found.append(document["accessors"][primitive["attributes"]["POSITION"]][end])
        slots.append(Thing())
        slots[-1].properties["material_slot_name"] = document["materials"][primitive["material"]]["name"]
    mesh.properties["static_materials"] = slots
    low = [min(one[axis] for one in corners["min"]) * 100 for axis in (0, 2, 1)]
    high = [max(one[axis] for one in corners["max"]) * 100 for axis in (0, 2, 1)]
    mesh.box = Box(Vector(*low), Vector(*high))


class AssetTools:
    @staticmethod
    def import_asset_tasks(tasks):
        for task in tasks:
            filename = task.properties["filename"]
            path = task.properties["destination_path"] + "/" + task.properties["destination_name"]
            if not os.path.exists(filename):
                task.properties["imported_object_paths"] = []
                continue
            if filename.endswith(".glb"):
                import_glb(path, filename)
            else:
                # The importer's own settings of a picture.
                editor.asset(path, "Texture2D", file=filename, srgb=not filename.endswith(".exr"), compression_settings="TC_DEFAULT",
                             mip_gen_settings="TMGS_FROM_TEXTURE_GROUP", address_x="TA_WRAP", address_y="TA_WRAP")
            task.properties["imported_object_paths"] = [path]

    @staticmethod
    def create_asset(name, folder, kind, _factory):
        return editor.asset(folder + "/" + name, kind.__name__)


class AssetToolsHelpers:
    get_asset_tools = AssetTools


class MaterialEditingLibrary:
    @staticmethod
    def create_material_expression(material, kind, _x, _y):
        node = kind()
        node.properties.update(kind=kind.__name__, material=material)
        editor.nodes.append(node)
        return node

    @staticmethod
    def connect_material_expressions(source, output, to, name):
        editor.links.append({"from": editor.nodes.index(source), "output": output, "to": editor.nodes.index(to), "input": name})

    @staticmethod
    def connect_material_property(source, _output, name):
        editor.links.append({"from": editor.nodes.index(source), "material": written(source.properties["material"]), "property": name})

    @staticmethod
    def recompile_material(_material):
        pass


class StaticMeshEditorSubsystem:
    def get_lod_build_settings(self, mesh, _lod):
        return mesh.get_editor_property("build_settings")

    def set_lod_build_settings(self, mesh, _lod, settings):
        mesh.set_editor_property("build_settings", settings)

    def get_nanite_settings(self, mesh):
        return mesh.get_editor_property("nanite_settings")

    def set_nanite_settings(self, mesh, settings, _apply_changes):
        mesh.set_editor_property("nanite_settings", settings)


class Actor(Thing):
    def set_actor_label(self, label):
        self.properties["label"] = label

    def actor_has_tag(self, tag):
        return tag in self.properties["tags"]


class LightComponent(Thing):
    def set_light_color(self, colour):
        self.properties["light_color"] = colour


class EditorActorSubsystem:
    def get_all_level_actors(self):
        return list(editor.actors)

    def destroy_actor(self, actor):
        editor.actors.remove(actor)

    def spawn(self, **properties):
        actor = Actor()
        actor.properties.update(properties, light_component=LightComponent())
        editor.actors.append(actor)
        return actor

    def spawn_actor_from_object(self, asset, location):
        return self.spawn(object=asset, location=location)

    def spawn_actor_from_class(self, kind, location, rotation):
        return self.spawn(kind=kind.__name__, location=location, rotation=rotation)


def get_editor_subsystem(kind):
    return kind()


def log(_text):
    pass


def __getattr__(name):
    if name.startswith("__"):
        raise AttributeError(name)
    globals()[name] = Kind(name, (Thing,), {})
    return globals()[name]


if __name__ == "__main__":
    sys.modules["unreal"] = sys.modules["__main__"]
    sys.path.insert(0, sys.argv[1])
    exec(sys.argv[2])
    nodes = [{name: written(value) for name, value in node.properties.items()} for node in editor.nodes]
    assets = {path: {name: written(value) for name, value in asset.properties.items()} for path, asset in editor.assets.items()}
    actors = [{name: written(value) for name, value in actor.properties.items()} for actor in editor.actors]
    print(json.dumps({"assets": assets, "nodes": nodes, "links": editor.links, "actors": actors}, indent=1))
