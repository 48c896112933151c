"""Mesh files with attributes, written and read record by record: what a face has, and nothing of where it stands in the file."""

import itertools
import math
import random
import re
import struct

import triangles as meshes

NAN = math.nan


class Scene:
    """Positions, some of them twice or in no face, and faces of any number of corners; polygons are flat and convex."""

    def __init__(self, seed, triangles=60, polygons=12, least=0):
        self.pick = pick = random.Random(seed)
        self.known = {}
        self.positions = [tuple(pick.randint(-16, 16) / 8 for _ in range(3)) for _ in range(triangles)]
        self.positions += pick.sample(self.positions, 5)
        self.faces = [[pick.randrange(triangles) for _ in range(3)] for _ in range(triangles)]
        self.faces += [[k, k, (k + 1) % triangles] for k in range(3)] + self.faces[:3]
        for _ in range(polygons):
            self.faces.append(self.polygon())
        self.positions.append((NAN, 0.0, 0.25))
        self.faces += [[len(self.positions) - 1, 0, 1], [len(self.positions) - 1, 0, 1, 2]]
        self.faces += [[pick.randrange(triangles) for _ in range(n)] for n in range(least, 3)] if least is not None else []
        pick.shuffle(self.faces)

    def polygon(self):
        """An octagon, or some of its corners."""
        pick, axis = self.pick, self.pick.randrange(3)
        middle, size = [pick.randint(-12, 12) / 8 for _ in range(3)], pick.randint(1, 8) / 8
        ring = [(2, -1), (2, 1), (1, 2), (-1, 2), (-2, 1), (-2, -1), (-1, -2), (1, -2)]
        first = len(self.positions)
        for u, v in [ring[k] for k in sorted(pick.sample(range(8), pick.randint(4, 8)))]:
            point = list(middle)
            point[(axis + 1) % 3] += u * size
            point[(axis + 2) % 3] += v * size
            self.positions.append(tuple(point))
        return list(range(first, len(self.positions)))

    def triangles(self, face):
        corners = [self.positions[c] for c in face]
        return [(corners[0], *corners[k:k + 2]) for k in range(1, len(corners) - 1)]

    def in_part(self, box, how="overlapping"):
        """The numbers of the faces that go into the part."""
        if (box, how) not in self.known:
            self.known[box, how] = list(self.find(box, how))
        return self.known[box, how]

    def find(self, box, how):
        for n, face in enumerate(self.faces):
            flat = [t for t in self.triangles(face) if not any(math.isnan(x) for v in t for x in v)]
            found = getattr(meshes, how)(flat, box)
            if found and (how != "inside" or len(found) == len(face) - 2):
                yield n


class Content:
    """Records of vertices, and faces as (corners, whatever else they have). other: what both sides should have."""

    def __init__(self, vertices, faces, other):
        self.vertices, self.faces, self.other = vertices, faces, other

    def of(self, chosen):
        """What a file of these faces should have."""
        faces = [self.faces[n] for n in chosen]
        used = sorted({c for corners, _ in faces for c in corners})
        place = {c: n for n, c in enumerate(used)}
        faces = [([place[c] for c in corners], rest) for corners, rest in faces]
        return Content([self.vertices[c] for c in used], faces, self.other)


# PLY. A schema is a list of elements: (name, count or None for the scene's, properties); a property is (name, type) or
# (name, type of the count, type).

def ply_value(pick, kind):
    if kind in ("float", "double"):
        return pick.choice((0.0, -1.5, 1e-30, NAN, 0.1 if kind == "double" else 0.5))
    bits = 8 * struct.calcsize(meshes.LETTERS[kind])
    return pick.randrange(1 << bits) - (1 << (bits - 1) if meshes.LETTERS[kind].islower() else 0)


def ply_records(pick, scene, element, properties, count):
    for n in range(count):
        record = []
        for name, *types in properties:
            if element == "vertex" and name in "xyz":
                record.append(scene.positions[n]["xyz".index(name)])
            elif element == "face" and name.startswith("vertex_ind"):
                record.append(list(scene.faces[n]))
            elif len(types) == 2:
                record.append([ply_value(pick, types[1]) for _ in range(pick.choice((0, 1, 3, 6)))])
            else:
                record.append(ply_value(pick, types[0]))
        yield record


def ply(scene, schema, form, line_end="\n"):
    pick, elements = random.Random(7), []
    for element, count, properties in schema:
        count = {"vertex": len(scene.positions), "face": len(scene.faces)}.get(element, count)
        elements.append((element, properties, list(ply_records(pick, scene, element, properties, count))))
    data = meshes.ply(elements, form, line_end, ("comment element vertex 3", "obj_info made by a test"))
    head, end, body = data.partition(b"end_header")
    return re.sub(rb"(?<=[\r\n])(element [^\r\n]*)([\r\n]+)", rb"\1\2comment after it\2", head) + end + body


class Cursor:
    """Takes values from the body of a PLY file; each comes with its bytes or its word, which say more than a number."""

    def __init__(self, body, form):
        self.order, self.at = "<" if "little" in form else ">", 0
        self.body = body.split() if form == "ascii" else body
        self.is_text = form == "ascii"

    def take(self, kind):
        if self.is_text:
            self.at += 1
            word = self.body[self.at - 1]
            return word, (float(word) if kind in ("float", "double") else int(word))
        size = struct.calcsize(meshes.LETTERS[kind])
        self.at += size
        raw = self.body[self.at - size:self.at]
        return raw, struct.unpack(self.order + meshes.LETTERS[kind], raw)[0]

    def take_property(self, types):
        if len(types) == 1:
            return [self.take(types[0])]
        return [self.take(types[1]) for _ in range(self.take(types[0])[1])]


def read_ply(data):
    end = re.search(rb"end_header(\r\n|\n|\r)", data)
    lines = data[:end.start()].decode().splitlines()
    form, schema, other = lines[1].split()[1], [], []
    for line in lines:
        words = line.split()
        if words[0] == "element":
            schema.append((words[1], int(words[2]), []))
        elif words[0] == "property":
            schema[-1][2].append((words[-1], *words[2 if words[1] == "list" else 1:-1]))
        other.append(line if words[:2] not in (["element", "vertex"], ["element", "face"]) else words[:2])
    cursor, vertices, faces = Cursor(data[end.end():], form), [], []
    for element, count, properties in schema:
        for _ in range(count):
            record, corners = [], None
            for name, *types in properties:
                values = cursor.take_property(types)
                if element == "face" and name.startswith("vertex_ind"):
                    corners = [int(value) for _, value in values]
                    record.append(len(values))
                else:
                    record.append([raw for raw, _ in values])
            if element == "face":
                faces.append((corners, record))
            elif element == "vertex":
                vertices.append(record)
            else:
                other.append((element, record))
    assert cursor.at == len(cursor.body), "something follows the last element"
    return Content(vertices, faces, other)


# OBJ: a vertex is its line and, for each use, a texture coordinate and a normal; state is what stands before a face.

def obj(scene, line_end="\n", is_negative=False, is_mixed=False):
    """Faces refer to texture coordinates and normals, or not, and stand among vertices where is_mixed."""
    pick, lines = random.Random(9), ["# made by a test", "mtllib some file.mtl", ""]
    counts = [len(scene.positions), 40, 30]
    written = [0, 0, 0]
    vertices = [("v", ["v %s%s" % (" ".join(map(repr, p)), pick.choice(("", " 0.5 0.25 1", " 1.0", "   # a comment")))
                       for p in scene.positions]),
                ("vt", ["vt 0.%d 0.5" % k for k in range(counts[1])]), ("vn", ["vn 0 0 %d" % k for k in range(counts[2])])]
    faces = []
    for n, corners in enumerate(scene.faces):
        if n % 7 == 0:
            faces.append(("state", pick.choice(("usemtl red", "usemtl blue light", "g a b", "o thing %d" % n, "s off", "s 1"))))
            faces.append(("state", "usemtl never" if n % 2 else "o empty"))
            faces.append(("state", "o thing of %d" % n))
            faces.append(("note", "# between"))
        form = pick.choice(("%d", "%d/%d", "%d//%d", "%d/%d/%d"))
        faces.append(("face", (corners, form, [(pick.randrange(counts[1]), pick.randrange(counts[2])) for _ in corners])))
    faces.append(("note", "l 1 2/3 4"))
    faces.append(("note", "p 5"))
    faces.append(("note", "curv 0 1 1 2"))
    blocks = [[("vertex", k, line) for line in block] for k, (_, block) in enumerate(vertices)]
    order = list(itertools.chain(*blocks)) + faces
    if is_mixed:  # each list stays in its order
        streams, order = [*blocks, faces], []
        while any(streams):
            stream = pick.choice([s for s in streams if s])
            order.append(stream.pop(0))
    for entry in order:
        if entry[0] == "vertex":
            written[entry[1]] += 1
            lines.append(entry[2])
        elif entry[0] == "face":
            lines.append(obj_face(*entry[1], written, is_negative, pick))
        else:
            lines.append(entry[1])
    return (line_end.join(lines) + line_end).encode()


def obj_face(corners, form, others, written, is_negative, pick):
    words = ["f"]
    for corner, (texture, normal) in zip(corners, others):
        numbers = [corner, texture, normal] if form.count("/") == 2 and "//" not in form else (
            [corner, normal] if "//" in form else [corner, texture])
        kinds = [0, 2] if "//" in form else [0, 1, 2]
        shown = []
        for number, kind in zip(numbers, kinds):
            can_be = is_negative and number < written[kind] and pick.random() < 0.7
            shown.append(number - written[kind] if can_be else number + 1)
        words.append(form % tuple(shown[:form.count("%d")]))
    if len(words) > 3 and pick.random() < 0.1:
        words.insert(2, "\\\n")
    return " ".join(words) + pick.choice(("", "", "  # a face"))


def read_obj(data):
    """Vertices are lines; the rest of a face are its textures, its normals and the state; other are comments and libraries."""
    text = re.sub(r"\\(\r\n|\n)", " ", data.decode())
    there, faces, state, other = {"v": [], "vt": [], "vn": []}, [], {}, []
    lines = re.split(r"\r\n|\n", text)
    for line in lines:
        word = line.split("#")[0].split()
        if word and word[0] in there:
            there[word[0]].append(line)
    here = {"v": 0, "vt": 0, "vn": 0}
    used = {"vt": set(), "vn": set()}
    for line in lines:
        word = line.split("#")[0].split()
        if not word or word[0] == "mtllib":
            other.append(line)
        elif word[0] in here:
            here[word[0]] += 1
        elif word[0] in ("f", "l", "p"):
            corners, rest = [], []
            for text in word[1:]:
                parts = dict(zip(("v", "vt", "vn"), text.split("/")))
                numbers = {k: (int(t) - 1 if int(t) > 0 else here[k] + int(t)) for k, t in parts.items() if t}
                corners.append(numbers["v"])
                for k in ("vt", "vn"):
                    if k in numbers:
                        used[k].add(numbers[k])
                rest.append([there[k][numbers[k]] if k in numbers else None for k in ("vt", "vn")])
            comment = line.partition("#")[2]
            faces.append((corners, (word[0], rest, dict(state) if word[0] == "f" else None, comment)))
        elif word[0] in ("usemtl", "g", "o", "s"):
            state[word[0]] = line
    content = Content(there["v"], faces, other)
    content.unused = sum(len(there[k]) - len(used[k]) for k in used)
    return content


# OFF: lines of vertices with colours, lines of faces with colours.

def off(scene, line_end="\n", head="COFF", is_joined=False):
    pick = random.Random(11)
    counts = "%d %d 12" % (len(scene.positions), len(scene.faces))
    lines = ["%s%s" % (head, counts)] if is_joined else [head, "# made by a test", counts]
    for p in scene.positions:
        lines.append(" ".join(map(repr, p)) + pick.choice((" 1 0 0 1", " 0.5 0.5 0.5 1   # coloured", "")))
        lines += pick.choice(([], [], ["  # a comment"], [""]))
    for face in scene.faces:
        lines.append("  " + " ".join(map(str, [len(face), *face])) + pick.choice(("", " 255 0 0", "  0.1 0.2 0.3 # blue")))
    return (line_end.join(lines) + line_end + "# the end" + line_end).encode()


def read_off(data):
    text = data.decode()
    lines = re.split(r"\r\n|\n", text)
    comments = [line.strip() for line in lines if line.strip().startswith("#")]
    lines = [line for line in lines if line.split("#")[0].strip()]
    head = re.match(r"(C?OFF)\s*(.*)", lines[0])
    rest = lines[1:] if head[2] else lines[2:]
    counts = [int(n) for n in (head[2] or lines[1]).split()]
    faces = []
    for line in rest[counts[0]:]:
        size = int(line.split()[0])
        found = re.match(r"\s*\d+((?:\s+\d+){%d})(.*)" % size, line)
        faces.append(([int(n) for n in found[1].split()], (size, found[2])))
    assert counts[1] == len(faces) and counts[2] in (0, 12), counts
    return Content(rest[:counts[0]], faces, (head[1], comments))


# STL and raw triangles have no vertices of their own: a face is all that it has.

def stl_text(scene, line_end="\n"):
    lines, faces = [], scene.faces
    for part in range(3):
        lines.append("solid part %d of 3" % part)
        for n in range(part * len(faces) // 3, (part + 1) * len(faces) // 3):
            lines += ["  facet normal %d 0 1" % n, "    outer loop"]
            lines += ["      vertex " + " ".join(map(repr, scene.positions[c])) for c in faces[n]]
            lines += ["    endloop", "  endfacet"]
        lines.append("endsolid part %d of 3" % part)
    return (line_end.join(lines) + line_end).encode()


def read_stl_text(data):
    faces, other = [], []
    for solid in re.finditer(r"solid ([^\r\n]*)(.*?)endsolid ([^\r\n]*)", data.decode(), re.DOTALL):
        other.append((solid[1], solid[3]))
        faces += [([], (solid[1], facet)) for facet in re.findall(r"\s+facet.*?endfacet", solid[2], re.DOTALL)]
    return Content([], faces, other)


def stl_binary(scene):
    """The last two bytes of a record are what the programs of some makers keep colours in."""
    body = b"".join(struct.pack("<12fH", n, 0, 0.5, *itertools.chain(*(scene.positions[c] for c in face)), 7 * n % 65536)
                    for n, face in enumerate(scene.faces))
    return b"a header of 80 bytes".ljust(80, b"\x01") + struct.pack("<I", len(scene.faces)) + body


def read_stl_binary(data):
    count = struct.unpack_from("<I", data, 80)[0]
    assert len(data) == 84 + 50 * count
    return Content([], [([], data[84 + 50 * n:134 + 50 * n]) for n in range(count)], data[:80])


def raw(scene, form):
    return b"".join(struct.pack("<9" + form, *itertools.chain(*(scene.positions[c] for c in face))) for face in scene.faces)


def read_raw(size):
    return lambda data: Content([], [([], data[k:k + 9 * size]) for k in range(0, len(data), 9 * size)], len(data) % (9 * size))
