"""Skin on a sphere: the exact formula against a picture that dermis wrote.

    python3 sphere_formula.py PICTURE.exr LAYER

The picture is builtin:unit (a sphere of 4 mm around the origin, gpu_gems_3, a white light of irradiance pi from 60
degrees to the left). LAYER is "diffuse" or "" for R, G, B. Prints the effect of scattering, what the picture misses of
it, and the captured share. Plain Python, and nothing of Dermis: neither its reader of EXR nor its mathematics.
"""
import json
import math
import struct
import sys
import zlib

RADIUS_MM = 4.0
ALBEDO = (0.8, 0.52, 0.42)
LIGHT = (-math.sin(math.radians(60)), 0.0, math.cos(math.radians(60)))
FIELD_OF_VIEW = 0.2
EYE_MM = 1.1 * RADIUS_MM / math.tan(FIELD_OF_VIEW / 2)
# d'Eon, Luebke 2007: variance in mm^2, weights of red, green, blue.
GAUSSIANS = [
    (0.0064, (0.233, 0.455, 0.649)), (0.0484, (0.100, 0.336, 0.344)), (0.187, (0.118, 0.198, 0.0)),
    (0.567, (0.113, 0.007, 0.007)), (1.99, (0.358, 0.004, 0.0)), (7.41, (0.078, 0.0, 0.0))]


def read_exr(path):
    """Width, height and {channel: rows of floats} of an uncompressed or ZIP file of half or float scan lines."""
    data = open(path, "rb").read()
    magic, version = struct.unpack_from("<II", data)
    assert magic == 20000630 and version & 0x1E00 == 0, "one part of scan lines"
    at, header = 8, {}
    while data[at]:
        name_end = data.index(0, at)
        type_end = data.index(0, name_end + 1)
        size, = struct.unpack_from("<i", data, type_end + 1)
        header[data[at:name_end].decode()] = data[type_end + 5:type_end + 5 + size]
        at = type_end + 5 + size
    channels, c, q = [], header["channels"], 0
    while c[q]:
        end = c.index(0, q)
        channels.append((c[q:end].decode(), {1: "e", 2: "f"}[struct.unpack_from("<i", c, end + 1)[0]]))
        q = end + 17
    x0, y0, x1, y1 = struct.unpack("<4i", header["dataWindow"])
    width, height, compression = x1 - x0 + 1, y1 - y0 + 1, header["compression"][0]
    lines = {0: 1, 2: 1, 3: 16}[compression]
    line_bytes = sum(width * (2 if kind == "e" else 4) for _, kind in channels)
    rows = {name: [] for name, _ in channels}
    for offset in struct.unpack_from("<%dQ" % -(-height // lines), data, at + 1):
        y, size = struct.unpack_from("<ii", data, offset)
        block, full = data[offset + 8:offset + 8 + size], line_bytes * min(lines, height - (y - y0))
        if compression and size < full:
            packed = bytearray(zlib.decompress(block))
            for i in range(1, len(packed)):  # differences, then two halves interleaved
                packed[i] = (packed[i - 1] + packed[i] - 128) & 255
            half = (len(packed) + 1) // 2
            block = bytearray(len(packed))
            block[0::2], block[1::2] = packed[:half], packed[half:]
        p = 0
        while p < len(block):
            for name, kind in channels:
                rows[name].append(struct.unpack_from("<%d%s" % (width, kind), block, p))
                p += width * (2 if kind == "e" else 4)
    return width, height, rows


def bessel_ratios(kappa, count):
    """I_{l+1/2}(kappa) / I_{1/2}(kappa) for l below count, by Miller's downward recurrence."""
    start = count + int(10 * math.sqrt(count)) + 20
    above, here, ratios = 0.0, 1e-300, [0.0] * count
    for l in range(start, 0, -1):
        above, here = here, above + (2 * l + 1) / kappa * here
        if l - 1 < count:
            ratios[l - 1] = here
        if here > 1e250:
            above, here, ratios = above * 1e-250, here * 1e-250, [r * 1e-250 for r in ratios]
    return [r / ratios[0] for r in ratios]


def legendre(t, count):
    values = [1.0, t]
    for l in range(1, count - 1):
        values.append(((2 * l + 1) * t * values[l] - l * values[l - 1]) / (l + 1))
    return values


def clamped_cosine(count):
    """Legendre coefficients of max(0, t), with the factor (2 l + 1) / 2."""
    a = [0.25, 0.5] + [0.0] * (count - 2)
    for l in range(2, count, 2):
        k = l // 2
        integral = (-1) ** (k + 1) * math.exp(math.lgamma(l - 1) - (l * math.log(2)) - math.lgamma(k)
                                                  - math.lgamma(k + 2))
        a[l] = (2 * l + 1) / 2 * integral
    return a


def exact_table(samples):
    """Red, green, blue of the blurred cosine at t = -1 ... 1."""
    count = 400
    a = clamped_cosine(count)
    kappas = [RADIUS_MM ** 2 / v for v, _ in GAUSSIANS]
    lobes = [[x * y for x, y in zip(a, bessel_ratios(kappa, count))] for kappa in kappas]
    closed = [1 - math.exp(-2 * kappa) for kappa in kappas]
    table = []
    for i in range(samples + 1):
        p = legendre(2 * i / samples - 1, count)
        blurred = [sum(x * y for x, y in zip(lobe, p)) for lobe in lobes]
        rgb = []
        for c in range(3):
            weights = [w[c] * part for (_, w), part in zip(GAUSSIANS, closed)]
            rgb.append(sum(w * b for w, b in zip(weights, blurred)) / sum(weights))
        table.append(rgb)
    return table


def n_dot_l(x, y, width, height):
    """At the middle of a pixel; nothing beyond the sphere or near its outline, where its facets show."""
    scale = math.tan(FIELD_OF_VIEW / 2)
    d = ((2 * (x + 0.5) / width - 1) * scale * width / height, (1 - 2 * (y + 0.5) / height) * scale, -1.0)
    length = math.sqrt(sum(v * v for v in d))
    d = [v / length for v in d]
    b = EYE_MM * d[2]
    root = b * b - EYE_MM ** 2 + RADIUS_MM ** 2
    if root < (0.2 * RADIUS_MM) ** 2:
        return None
    s = -b - math.sqrt(root)
    n = [s * d[0] / RADIUS_MM, s * d[1] / RADIUS_MM, (EYE_MM + s * d[2]) / RADIUS_MM]
    return sum(v * l for v, l in zip(n, LIGHT))


def main():
    width, height, rows = read_exr(sys.argv[1])
    prefix = sys.argv[2] + "." if sys.argv[2] else ""
    samples = 400
    table = exact_table(samples)
    effect = missed = noise = 0.0
    pixels = 0
    for y in range(height):
        for x in range(width):
            t = n_dot_l(x, y, width, height)
            if t is None:
                continue
            pixels += 1
            place = (t + 1) / 2 * samples
            i = min(int(place), samples - 1)
            for c, name in enumerate("RGB"):
                exact = table[i][c] + (table[i + 1][c] - table[i][c]) * (place - i)
                effect += (ALBEDO[c] * (exact - max(t, 0.0))) ** 2
                missed += (rows[prefix + name][y][x] - ALBEDO[c] * exact) ** 2
                if "variance." + name in rows:
                    noise += rows["variance." + name][y][x]
    share = 1 - math.sqrt(max(0.0, missed - noise) / effect)
    rms = [math.sqrt(v / (3 * pixels)) for v in (effect, missed, noise)]
    print(json.dumps({"pixels": pixels, "effect": rms[0], "missed": rms[1], "noise": rms[2], "captured": share}))


main()
