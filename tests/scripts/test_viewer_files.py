#!/usr/bin/env python3
"""Reads the VTU and GLB files of the C++ tests with readers of its own, and with VTK where python3-vtk9 is installed."""
import json
import os
import struct
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree
import zlib
from pathlib import Path


def read_vtu(path):
    """All arrays of a .vtu with zlib-compressed raw appended data, as tuples of numbers, and the counts."""
    raw = path.read_bytes()
    start = raw.index(b'<AppendedData encoding="raw">')
    data = raw.index(b"_", start) + 1
    root = ElementTree.fromstring(raw[:start].decode() + "</VTKFile>")
    assert root.get("header_type") == "UInt64" and root.get("compressor") == "vtkZLibDataCompressor"
    piece = root.find("UnstructuredGrid/Piece")
    letters = {"Float64": "d", "Float32": "f", "Int32": "i", "UInt8": "B"}
    arrays = {}
    for node in piece.iter("DataArray"):
        at = data + int(node.get("offset"))
        n_blocks, block, last = struct.unpack_from("<3Q", raw, at)
        sizes = struct.unpack_from(f"<{n_blocks}Q", raw, at + 24)
        at += 24 + 8 * n_blocks
        body = b""
        for size in sizes:
            body += zlib.decompress(raw[at:at + size])
            at += size
        assert len(body) == (block * (n_blocks - 1) + last if last else block * n_blocks)
        arrays[node.get("Name")] = struct.unpack(f"<{len(body) // struct.calcsize(letters[node.get('type')])}"
                                                 f"{letters[node.get('type')]}", body)
    return int(piece.get("NumberOfPoints")), int(piece.get("NumberOfCells")), arrays


def check_vtu(path):
    n_points, n_cells, arrays = read_vtu(path)
    assert len(arrays["Points"]) == 3 * n_points and len(arrays["rest"]) == 3 * n_points
    assert arrays["offsets"] == tuple(range(3, 3 * n_cells + 1, 3)) and set(arrays["types"]) == {5}
    assert 0 <= min(arrays["connectivity"]) and max(arrays["connectivity"]) == n_points - 1
    assert all(1 <= v < 2 for v in arrays["lambda1"]) and set(arrays["state"]) <= {0, 1, 2}
    for f in range(n_cells):
        assert abs(sum(c * c for c in arrays["direction"][3 * f:3 * f + 3]) - 1) < 1e-5
    return n_points, n_cells


def check_glb(path):
    raw = path.read_bytes()
    magic, version, length, json_size, json_type = struct.unpack_from("<4sIII4s", raw)
    assert (magic, version, length, json_type) == (b"glTF", 2, len(raw), b"JSON")
    root = json.loads(raw[20:20 + json_size])
    binary = raw[28 + json_size:]
    assert len(binary) == root["buffers"][0]["byteLength"]
    size = {5126: 4, 5125: 4, 5123: 2}
    width = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}
    for accessor in root["accessors"]:
        view = root["bufferViews"][accessor["bufferView"]]
        assert view["byteOffset"] % 4 == 0 and view["byteOffset"] + view["byteLength"] <= len(binary)
        assert accessor["count"] * width[accessor["type"]] * size[accessor["componentType"]] == view["byteLength"]
    primitive = root["meshes"][0]["primitives"][0]
    index = root["accessors"][primitive["indices"]]
    offset = root["bufferViews"][index["bufferView"]]["byteOffset"]
    corners = struct.unpack_from(f"<{index['count']}I", binary, offset)
    assert max(corners) < root["accessors"][primitive["attributes"]["POSITION"]]["count"]


def check_with_vtk(path, n_points, n_cells):
    try:
        from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
    except ImportError:
        print("python3-vtk9 is not installed: VTK itself was not asked")
        return
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    grid = reader.GetOutput()
    assert (grid.GetNumberOfPoints(), grid.GetNumberOfCells()) == (n_points, n_cells)
    low, high = grid.GetCellData().GetArray("lambda1").GetRange()
    assert 1 <= low < high < 2
    assert grid.GetCellData().GetArray("direction").GetNumberOfComponents() == 3
    print("VTK reads the same")


def main():
    program = Path(sys.argv[1]) / "tests" / "test_formwork"
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([program, "a VTU holds*,a GLB holds*"], check=True, stdout=subprocess.DEVNULL,
                       env={**os.environ, "FORMWORK_TEST_OUTPUT": folder})
        files = Path(folder) / "viewer_files"
        n_points, n_cells = check_vtu(files / "inflated.vtu")
        check_with_vtk(files / "inflated.vtu", n_points, n_cells)
        check_glb(files / "panels.glb")
        series = ElementTree.parse(files / "series.pvd").findall("Collection/DataSet")
        assert [float(d.get("timestep")) for d in series] == [0, 0.04]
        assert all((files / d.get("file")).exists() for d in series)
    print(f"{n_points} nodes and {n_cells} faces read back")


if __name__ == "__main__":
    main()
