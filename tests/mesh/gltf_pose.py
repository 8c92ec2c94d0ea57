"""Posed glTF files, evaluated from the text of the glTF 2.0 specification, without code of dermis.

gltf_pose.py write FOLDER                writes small files, one for each kind of motion
gltf_pose.py evaluate FILE CLIP TIME     prints the positions of all vertices in millimetres, one a line
"""

import base64
import json
import math
import pathlib
import random
import struct
import sys
import urllib.parse

FORMATS = {5120: "b", 5121: "B", 5122: "h", 5123: "H", 5125: "I", 5126: "f"}
LARGEST = {5120: 127, 5121: 255, 5122: 32767, 5123: 65535}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}


# Reading -----------------------------------------------------------------------------------------------------


class File:
    """A .glb, or a .gltf with its buffers in it or beside it."""

    def __init__(self, path):
        path = pathlib.Path(path)
        data, chunk = path.read_bytes(), b""
        if data[:4] == b"glTF":
            length = struct.unpack_from("<I", data, 12)[0]
            data, chunk = data[20 : 20 + length], data[28 + length :]
        self.json = json.loads(data.decode("utf-8-sig"))
        self.buffers = [self.buffer(path.parent, b["uri"]) if "uri" in b else chunk for b in self.json["buffers"]]

    @staticmethod
    def buffer(folder, uri):
        if uri.startswith("data:"):
            return base64.b64decode(uri.partition(",")[2])
        return (folder / urllib.parse.unquote(uri)).read_bytes()

    def elements(self, view, offset, component, width, count):
        """Section 3.6.2."""
        view = self.json["bufferViews"][view]
        code, size = FORMATS[component], struct.calcsize(FORMATS[component])
        stride = view.get("byteStride", size * width)
        start, data = view.get("byteOffset", 0) + offset, self.buffers[view["buffer"]]
        return [list(struct.unpack_from("<%d%s" % (width, code), data, start + i * stride)) for i in range(count)]

    def accessor(self, index):
        a = self.json["accessors"][index]
        kind, width = a["componentType"], WIDTHS[a["type"]]
        values = [[0] * width for _ in range(a["count"])]
        if "bufferView" in a:
            values = self.elements(a["bufferView"], a.get("byteOffset", 0), kind, width, a["count"])
        if "sparse" in a:
            s = a["sparse"]
            at, new = s["indices"], s["values"]
            places = self.elements(at["bufferView"], at.get("byteOffset", 0), at["componentType"], 1, s["count"])
            changed = self.elements(new["bufferView"], new.get("byteOffset", 0), kind, width, s["count"])
            for (place,), value in zip(places, changed):
                values[place] = value
        if a.get("normalized"):
            values = [[max(v / LARGEST[kind], -1) for v in value] for value in values]
        return values


# Appendix C: between keys ------------------------------------------------------------------------------------


def unit(q):
    length = math.sqrt(sum(v * v for v in q))
    return [v / length for v in q]


def slerp(a, b, t):
    d = sum(x * y for x, y in zip(a, b))
    angle = math.acos(min(1, abs(d)))
    if angle < 1e-6:
        return [(1 - t) * x + t * math.copysign(1, d) * y for x, y in zip(a, b)]
    s = math.copysign(1, d)
    return [
        (math.sin((1 - t) * angle) * x + s * math.sin(t * angle) * y) / math.sin(angle) for x, y in zip(a, b)
    ]


def value_at(file, sampler, time, path, width):
    times = [t for (t,) in file.accessor(sampler["input"])]
    flat = [v for value in file.accessor(sampler["output"]) for v in value]
    kind = sampler.get("interpolation", "LINEAR")
    cubic = kind == "CUBICSPLINE"

    def key(k, part=1):
        first = (3 * k + part if cubic else k) * width
        return flat[first : first + width]

    last = len(times) - 1
    if time <= times[0]:
        value = key(0)
    elif time >= times[-1]:
        value = key(last)
    else:
        k = max(i for i in range(last) if times[i] <= time)
        length = times[k + 1] - times[k]
        t = (time - times[k]) / length
        if kind == "STEP":
            value = key(k)
        elif cubic:
            h = [2 * t**3 - 3 * t**2 + 1, length * (t**3 - 2 * t**2 + t), 3 * t**2 - 2 * t**3, length * (t**3 - t**2)]
            rows = zip(key(k), key(k, 2), key(k + 1), key(k + 1, 0))
            value = [sum(x * y for x, y in zip(h, row)) for row in rows]
        elif path == "rotation":
            value = slerp(key(k), key(k + 1), t)
        else:
            value = [(1 - t) * x + t * y for x, y in zip(key(k), key(k + 1))]
    return unit(value) if path == "rotation" else value


# Nodes, morph targets, skins ---------------------------------------------------------------------------------


def product(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(4)) for j in range(4)] for i in range(4)]


def from_columns(m):
    return [[m[4 * j + i] for j in range(4)] for i in range(4)]


def local(node):
    if "matrix" in node:
        return from_columns(node["matrix"])
    x, y, z, w = unit(node.get("rotation", [0, 0, 0, 1]))
    s, t = node.get("scale", [1, 1, 1]), node.get("translation", [0, 0, 0])
    r = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    return [[r[i][j] * s[j] for j in range(3)] + [t[i]] for i in range(3)] + [[0, 0, 0, 1]]


def play(file, clip, time):
    nodes = file.json["nodes"]
    for channel in clip["channels"]:
        target = channel["target"]
        if "node" not in target:
            continue
        node, path = nodes[target["node"]], target["path"]
        width = {"rotation": 4, "translation": 3, "scale": 3}.get(path)
        if path == "weights":
            width = len(file.json["meshes"][node["mesh"]]["primitives"][0]["targets"])
        node[path] = value_at(file, clip["samplers"][channel["sampler"]], time, path, width)


def globals_of(nodes):
    parents = {child: i for i, node in enumerate(nodes) for child in node.get("children", [])}

    def of(i):
        return product(of(parents[i]), local(nodes[i])) if i in parents else local(nodes[i])

    return [of(i) for i in range(len(nodes))]


def drawn(json_, index):
    yield index
    for child in json_["nodes"][index].get("children", []):
        yield from drawn(json_, child)


def transform(m, p):
    return [sum(m[i][k] * p[k] for k in range(3)) + m[i][3] for i in range(3)]


def morphed(file, primitive, weights):
    positions = file.accessor(primitive["attributes"]["POSITION"])
    for weight, target in zip(weights, primitive.get("targets", [])):
        if weight:
            for p, change in zip(positions, file.accessor(target["POSITION"])):
                for k in range(3):
                    p[k] += weight * change[k]
    return positions


def skinned(file, primitive, joints, positions):
    attributes, sets = primitive["attributes"], 0
    influences = [[] for _ in positions]
    while "JOINTS_%d" % sets in attributes:
        numbers = file.accessor(attributes["JOINTS_%d" % sets])
        weights = file.accessor(attributes["WEIGHTS_%d" % sets])
        for i, (n, w) in enumerate(zip(numbers, weights)):
            influences[i] += list(zip(n, w))
        sets += 1
    moved = []
    for p, some in zip(positions, influences):
        total = sum(w for _, w in some)
        places = [(w / total, transform(joints[n], p)) for n, w in some if w]
        moved.append([sum(w * q[k] for w, q in places) for k in range(3)])
    return moved


def joints_of(file, skin, world):
    if "inverseBindMatrices" not in skin:
        return [world[j] for j in skin["joints"]]
    return [product(world[j], from_columns(b)) for j, b in zip(skin["joints"], file.accessor(skin["inverseBindMatrices"]))]


def posed(file):
    """Each primitive of the scene that is drawn, with its positions in metres."""
    nodes = file.json["nodes"]
    world = globals_of(nodes)
    scene = file.json["scenes"][file.json.get("scene", 0)]
    for index in [i for root in scene["nodes"] for i in drawn(file.json, root)]:
        node = nodes[index]
        if "mesh" not in node:
            continue
        mesh = file.json["meshes"][node["mesh"]]
        joints = None
        if "skin" in node:
            joints = joints_of(file, file.json["skins"][node["skin"]], world)
        for primitive in mesh["primitives"]:
            positions = morphed(file, primitive, node.get("weights", mesh.get("weights", [])))
            if joints:
                positions = skinned(file, primitive, joints, positions)
            else:
                positions = [transform(world[index], p) for p in positions]
            yield primitive, positions


# Of each time a list of positions; an empty line ends it.
def evaluate(path, clip_name, times):
    for time in times:
        file = File(path)
        clips = [a for a in file.json.get("animations", []) if a["name"] == clip_name]
        if clips:
            play(file, clips[0], time)
        for _, positions in posed(file):
            for p in positions:
                print("%.9g %.9g %.9g" % tuple(1000 * v for v in p))
        print()


# Writing -----------------------------------------------------------------------------------------------------


class Writer:
    def __init__(self, seed):
        self.random = random.Random(seed)
        self.binary = b""
        self.json = {
            "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}], "nodes": [], "meshes": [],
            "accessors": [], "bufferViews": [], "animations": [{"name": "move", "channels": [], "samplers": []}],
        }  # fmt: skip

    def numbers(self, count, low=-1.0, high=1.0):
        return [self.random.uniform(low, high) for _ in range(count)]

    def view(self, code, values):
        self.binary += b"\0" * (-len(self.binary) % 4)
        data = struct.pack("<%d%s" % (len(values), code), *values)
        self.json["bufferViews"].append({"buffer": 0, "byteOffset": len(self.binary), "byteLength": len(data)})
        self.binary += data
        return len(self.json["bufferViews"]) - 1

    def accessor(self, kind, values, component=5126, normalized=False):
        if normalized:
            values = [round(v * LARGEST[component]) for v in values]
        a = {"bufferView": self.view(FORMATS[component], values), "componentType": component, "type": kind}
        a["count"] = len(values) // WIDTHS[kind]
        if normalized:
            a["normalized"] = True
        self.json["accessors"].append(a)
        return len(self.json["accessors"]) - 1

    def sparse(self, count, places):
        """Moves some of `count` vertices; the others have no bytes."""
        values = self.numbers(3 * len(places), -0.1, 0.1)
        self.json["accessors"].append({
            "componentType": 5126, "type": "VEC3", "count": count,
            "sparse": {
                "count": len(places),
                "indices": {"bufferView": self.view("H", places), "componentType": 5123},
                "values": {"bufferView": self.view("f", values)},
            },
        })  # fmt: skip
        return len(self.json["accessors"]) - 1

    def node(self, parent=None, **content):
        self.json["nodes"].append(content)
        index = len(self.json["nodes"]) - 1
        if parent is None:
            self.json["scenes"][0]["nodes"].append(index)
        else:
            self.json["nodes"][parent].setdefault("children", []).append(index)
        return index

    def mesh(self, count=12, sets=0, joints=0, targets=(), small=False):
        """A strip of triangles; `targets` are any of "full", "sparse", "normals"."""
        positions = [v for i in range(count) for v in (0.1 * (i // 2), 0.1 * (i % 2), 0.01 * self.random.random())]
        attributes = {"POSITION": self.accessor("VEC3", positions), "NORMAL": self.accessor("VEC3", [0, 0, 1.0] * count)}
        for s in range(sets):
            numbers = [self.random.randrange(joints) for _ in range(4 * count)]
            attributes["JOINTS_%d" % s] = self.accessor("VEC4", numbers, 5121 if small else 5123)
            weights = self.numbers(4 * count, 0.1, 1)
            for first in range(0, len(weights), 4):
                total = sum(weights[first : first + 4])
                weights[first : first + 4] = [w / total / sets for w in weights[first : first + 4]]
            attributes["WEIGHTS_%d" % s] = self.accessor("VEC4", weights, 5123 if small else 5126, small)
        triangles = [k for i in range(count - 2) for k in ((i, i + 1, i + 2) if i % 2 == 0 else (i + 1, i, i + 2))]
        primitive = {"attributes": attributes, "indices": self.accessor("SCALAR", triangles, 5123)}
        for kind in targets:
            target = {"POSITION": self.accessor("VEC3", self.numbers(3 * count, -0.1, 0.1))}
            if kind == "sparse":
                target = {"POSITION": self.sparse(count, [1, 4, 7])}
            if kind == "normals":
                target["NORMAL"] = self.accessor("VEC3", self.numbers(3 * count, -0.1, 0.1))
                target["TANGENT"] = self.accessor("VEC3", self.numbers(3 * count, -0.1, 0.1))
            primitive.setdefault("targets", []).append(target)
        mesh = {"primitives": [primitive]}
        if targets:
            mesh["weights"] = self.numbers(len(targets), 0, 1)
            mesh["extras"] = {"targetNames": ["shape%d" % i for i in range(len(targets))]}
        self.json["meshes"].append(mesh)
        return len(self.json["meshes"]) - 1

    def skin(self, joints):
        binds = []
        for _ in joints:
            m = local({"rotation": self.numbers(4), "translation": self.numbers(3, -0.2, 0.2)})
            binds += [m[i][j] for j in range(4) for i in range(4)]
        skin = {"joints": joints, "inverseBindMatrices": self.accessor("MAT4", binds)}
        self.json.setdefault("skins", []).append(skin)
        return len(self.json["skins"]) - 1

    def channel(self, node, path, interpolation, width=3, component=5126):
        times = [0.25, 0.5, 1.25, 2.0]
        count = len(times) * (3 if interpolation == "CUBICSPLINE" else 1)
        values = self.numbers(width * count, 0.2 if path == "scale" else -1, 1)
        kind = {"rotation": "VEC4", "weights": "SCALAR"}.get(path, "VEC3")
        if path == "rotation" and interpolation != "CUBICSPLINE":
            values = [v for first in range(0, len(values), 4) for v in unit(values[first : first + 4])]
        clip = self.json["animations"][0]
        output = self.accessor(kind, values, component, component != 5126)
        clip["samplers"].append(
            {"input": self.accessor("SCALAR", times), "output": output, "interpolation": interpolation}
        )
        target = {"node": node, "path": path}
        clip["channels"].append({"sampler": len(clip["samplers"]) - 1, "target": target})

    def save(self, path):
        self.json["buffers"] = [{"byteLength": len(self.binary)}]
        text = json.dumps(self.json).encode()
        text += b" " * (-len(text) % 4)
        binary = self.binary + b"\0" * (-len(self.binary) % 4)
        chunks = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(binary), 0x004E4942) + binary
        open(path, "wb").write(struct.pack("<III", 0x46546C67, 2, 12 + len(chunks)) + chunks)


def write_nodes(folder, interpolation):
    w = Writer(interpolation)
    root = w.node(matrix=[1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0.1, 0.2, 0.3, 1])
    arm = w.node(root, translation=[0.1, 0, 0], rotation=unit([1, 2, 3, 4]), scale=[1, 2, 1])
    hand = w.node(arm, mesh=w.mesh())
    w.channel(arm, "translation", interpolation)
    w.channel(arm, "rotation", interpolation, 4)
    w.channel(hand, "scale", interpolation)
    w.channel(hand, "rotation", interpolation, 4, 5122 if interpolation != "CUBICSPLINE" else 5126)
    w.save("%s/nodes_%s.glb" % (folder, interpolation.lower()))


def write_weights(folder, interpolation):
    w = Writer("weights" + interpolation)
    kinds = ("full", "sparse", "normals")
    w.node(mesh=w.mesh(targets=kinds), weights=[1, 0, 0.5])
    w.channel(0, "weights", interpolation, 3)
    w.node(mesh=w.mesh(targets=kinds), translation=[0, 0.5, 0])
    w.save("%s/weights_%s.glb" % (folder, interpolation.lower()))


def write_skins(folder, name, sets, small, targets=()):
    w = Writer(name)
    for _ in range(2):  # two skins
        bones = [w.node(translation=[0, 0.1, 0])]
        for _ in range(4):
            bones.append(w.node(bones[-1], translation=[0, 0.1, 0]))
        mesh = w.mesh(sets=sets, joints=len(bones), targets=targets, small=small)
        face = w.node(mesh=mesh, skin=w.skin(bones), translation=[9, 9, 9])
        w.channel(bones[1], "rotation", "LINEAR", 4)
        w.channel(bones[3], "translation", "CUBICSPLINE")
        w.channel(bones[2], "scale", "STEP")
        if targets:
            w.channel(face, "weights", "LINEAR", len(targets))
    w.save("%s/%s.glb" % (folder, name))


def write(folder):
    for interpolation in ("STEP", "LINEAR", "CUBICSPLINE"):
        write_nodes(folder, interpolation)
        write_weights(folder, interpolation)
    write_skins(folder, "skin_4", 1, False)
    write_skins(folder, "skin_8", 2, False)
    write_skins(folder, "skin_8_small", 2, True)
    write_skins(folder, "skin_and_morph", 1, False, ("sparse", "full"))


if __name__ == "__main__":
    if sys.argv[1] == "write":
        write(sys.argv[2])
    else:
        evaluate(sys.argv[2], sys.argv[3], [float(time) for time in sys.argv[4:]])
