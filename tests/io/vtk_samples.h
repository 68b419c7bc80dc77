// One small surface as VTK 9 writes it: a pyramid of a quad and four triangles and a line beside it, with colours,
// normals, texture coordinates, data of points (one is no number, one is in bits) and cells, and Slicer's mark of its
// coordinates.
#pragma once

namespace meshtween {

// version 5.1, text
constexpr const char* vtk_text_5 = R"file(# vtk DataFile Version 5.1
3D Slicer output. SPACE=LPS
ASCII
DATASET POLYDATA
FIELD FieldData 1
SPACE 1 1 string
LPS

POINTS 5 float
0 0 0 2 0 0 2 2 0 
0 2 0 1 1 1.1 
LINES 2 2
OFFSETS vtktypeint64
0 2 
CONNECTIVITY vtktypeint64
0 2 
POLYGONS 6 16
OFFSETS vtktypeint64
0 4 7 10 13 16 
CONNECTIVITY vtktypeint64
0 3 2 1 0 1 4 1 2 
4 2 3 4 3 0 4 
CELL_DATA 6
FIELD FieldData 1
label 1 6 vtkIdType
0 1 2 3 4 5 
POINT_DATA 5
COLOR_SCALARS RGB 3
1 0 0 0 1 0 0 0 1 
0.0117647 0.0156863 0.0196078 1 1 1 

NORMALS Normals float
0.303463 -0.863433 0.402982 0.671485 -0.671485 0.313396 0.905266 0.38498 0.179678 
-0.671485 0.671485 0.313396 0 0 1 
TEXTURE_COORDINATES TCoords 2 float
0 0 1 0 1 1 0 1 0.5 
0.5 
FIELD FieldData 2
my%20curvature 1 5 double
1.5 2.5 nan 4 5 
bits 1 5 bit
0 1 0 1 0
)file";

// version 4.2, binary
constexpr const char* vtk_binary_4_base64 =
    "IyB2dGsgRGF0YUZpbGUgVmVyc2lvbiA0LjIKM0QgU2xpY2VyIG91dHB1dC4gU1BBQ0U9TFBTCkJJTkFSWQpEQVRBU0VUIFBPTFlE"
    "QVRBCkZJRUxEIEZpZWxkRGF0YSAxClNQQUNFIDEgMSBzdHJpbmcKw0xQUwpQT0lOVFMgNSBmbG9hdAoAAAAAAAAAAAAAAABAAAAA"
    "AAAAAAAAAABAAAAAQAAAAAAAAAAAAAAAQAAAAAAAAAA/gAAAP4AAAD+MzM0KTElORVMgMSAzCgAAAAIAAAAAAAAAAgpQT0xZR09O"
    "UyA1IDIxCgAAAAQAAAAAAAAAAwAAAAIAAAABAAAAAwAAAAAAAAABAAAABAAAAAMAAAABAAAAAgAAAAQAAAADAAAAAgAAAAMAAAAE"
    "AAAAAwAAAAMAAAAAAAAABApDRUxMX0RBVEEgNgpGSUVMRCBGaWVsZERhdGEgMQpsYWJlbCAxIDYgdnRrSWRUeXBlCgAAAAAAAAAB"
    "AAAAAgAAAAMAAAAEAAAABQpQT0lOVF9EQVRBIDUKQ09MT1JfU0NBTEFSUyBSR0IgMwr/AAAA/wAAAP8DBAX///8KTk9STUFMUyBO"
    "b3JtYWxzIGZsb2F0Cj6bX3W/XQnrPs5Trj8r5mm/K+ZpPqB1cD9nv38+xRwePjf9mb8r5mk/K+ZpPqB1cAAAAAAAAAAAP4AAAApU"
    "RVhUVVJFX0NPT1JESU5BVEVTIFRDb29yZHMgMiBmbG9hdAoAAAAAAAAAAD+AAAAAAAAAP4AAAD+AAAAAAAAAP4AAAD8AAAA/AAAA"
    "CkZJRUxEIEZpZWxkRGF0YSAyCm15JTIwY3VydmF0dXJlIDEgNSBkb3VibGUKP/gAAAAAAABABAAAAAAAAH/4AAAAAAAAQBAAAAAA"
    "AABAFAAAAAAAAApiaXRzIDEgNSBiaXQKUAo=";

// version 5.1, binary
constexpr const char* vtk_binary_5_base64 =
    "IyB2dGsgRGF0YUZpbGUgVmVyc2lvbiA1LjEKM0QgU2xpY2VyIG91dHB1dC4gU1BBQ0U9TFBTCkJJTkFSWQpEQVRBU0VUIFBPTFlE"
    "QVRBCkZJRUxEIEZpZWxkRGF0YSAxClNQQUNFIDEgMSBzdHJpbmcKw0xQUwpQT0lOVFMgNSBmbG9hdAoAAAAAAAAAAAAAAABAAAAA"
    "AAAAAAAAAABAAAAAQAAAAAAAAAAAAAAAQAAAAAAAAAA/gAAAP4AAAD+MzM0KTElORVMgMiAyCk9GRlNFVFMgdnRrdHlwZWludDY0"
    "CgAAAAAAAAAAAAAAAAAAAAIKQ09OTkVDVElWSVRZIHZ0a3R5cGVpbnQ2NAoAAAAAAAAAAAAAAAAAAAACClBPTFlHT05TIDYgMTYK"
    "T0ZGU0VUUyB2dGt0eXBlaW50NjQKAAAAAAAAAAAAAAAAAAAABAAAAAAAAAAHAAAAAAAAAAoAAAAAAAAADQAAAAAAAAAQCkNPTk5F"
    "Q1RJVklUWSB2dGt0eXBlaW50NjQKAAAAAAAAAAAAAAAAAAAAAwAAAAAAAAACAAAAAAAAAAEAAAAAAAAAAAAAAAAAAAABAAAAAAAA"
    "AAQAAAAAAAAAAQAAAAAAAAACAAAAAAAAAAQAAAAAAAAAAgAAAAAAAAADAAAAAAAAAAQAAAAAAAAAAwAAAAAAAAAAAAAAAAAAAAQK"
    "Q0VMTF9EQVRBIDYKRklFTEQgRmllbGREYXRhIDEKbGFiZWwgMSA2IHZ0a0lkVHlwZQoAAAAAAAAAAQAAAAIAAAADAAAABAAAAAUK"
    "UE9JTlRfREFUQSA1CkNPTE9SX1NDQUxBUlMgUkdCIDMK/wAAAP8AAAD/AwQF////Ck5PUk1BTFMgTm9ybWFscyBmbG9hdAo+m191"
    "v10J6z7OU64/K+ZpvyvmaT6gdXA/Z79/PsUcHj43/Zm/K+ZpPyvmaT6gdXAAAAAAAAAAAD+AAAAKVEVYVFVSRV9DT09SRElOQVRF"
    "UyBUQ29vcmRzIDIgZmxvYXQKAAAAAAAAAAA/gAAAAAAAAD+AAAA/gAAAAAAAAD+AAAA/AAAAPwAAAApGSUVMRCBGaWVsZERhdGEg"
    "MgpteSUyMGN1cnZhdHVyZSAxIDUgZG91YmxlCj/4AAAAAAAAQAQAAAAAAAB/+AAAAAAAAEAQAAAAAAAAQBQAAAAAAAAKYml0cyAx"
    "IDUgYml0ClAK";

// compressed, appended as base64, headers of 32 bits
constexpr const char* vtp_appended_base64 = R"file(<?xml version="1.0"?>
<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian" header_type="UInt32" compressor="vtkZLibDataCompressor">
<PolyData>
<FieldData>
<Array type="String" Name="SPACE" NumberOfTuples="1" format="appended" offset="0"/></FieldData>
<Piece NumberOfPoints="5" NumberOfVerts="0" NumberOfLines="1" NumberOfStrips="0" NumberOfPolys="5">
<PointData Scalars="RGB" Normals="Normals" TCoords="TCoords">
<DataArray type="UInt8" Name="RGB" NumberOfComponents="3" format="appended" offset="40"/>
<DataArray type="Float32" Name="TCoords" NumberOfComponents="2" format="appended" offset="92"/>
<DataArray type="Float32" Name="Normals" NumberOfComponents="3" format="appended" offset="144"/>
<DataArray type="Float64" Name="my curvature" format="appended" offset="240"/>
<DataArray type="Bit" Name="bits" format="appended" offset="304"/></PointData>
<CellData>
<DataArray type="Int64" IdType="1" Name="label" format="appended" offset="340"/></CellData>
<Points>
<DataArray type="Float32" Name="Points" NumberOfComponents="3" format="appended" offset="396"/></Points>
<Lines>
<DataArray type="Int64" Name="connectivity" format="appended" offset="488"/>
<DataArray type="Int64" Name="offsets" format="appended" offset="532"/></Lines>
<Polys>
<DataArray type="Int64" Name="connectivity" format="appended" offset="604"/>
<DataArray type="Int64" Name="offsets" format="appended" offset="680"/></Polys></Piece></PolyData>
<AppendedData encoding="base64">
   _AQAAAACAAAAEAAAADAAAAA==eF7zCQhmAAACygDwAQAAAACAAAAPAAAAFQAAAA==eF77z8DA8B+EmVlY////DwAnIgYHAQAAAACAAAAoAAAAEwAAAA==eF5jYICBBnsEjcxmAGMAPFYDew==AQAAAACAAAA8AAAANgAAAA==eF4rjZ9t95ozdv+64HN2mc+07YF4f0HpArv6/en2cjJH7Wb+NQeJ7wfJgcQZ4KDBHgA5oxcgAQAAAACAAAAoAAAAHAAAAA==eF5jYACBH/ZgioHFAUL/qIfQAlC+iAMATQYDlw==AQAAAACAAAABAAAACQAAAA==eF4LAAAAUQBRAQAAAACAAAAwAAAAGAAAAA==eF5jYIAARijNBKWZoTQLlGaF0gABSAAQAQAAAACAAAA8AAAAGQAAAA==eF5jYEABDmhsdD4QNNiD8NkzPfYAMZ0E4w==AAAAAACAAAAAAAAAAAAAAACAAAAAAAAAAQAAAACAAAAQAAAADgAAAA==eF5jYIAAJigNAAAgAAM=AQAAAACAAAAIAAAACwAAAA==eF5jYoAAAAAYAAM=AAAAAACAAAAAAAAAAAAAAACAAAAAAAAAAQAAAACAAACAAAAAJwAAAA==eF5jYIAAZijNBKUZGVABjM+Cxoeph4nD+DDzYOIwPgzAxAEIMAAjAQAAAACAAAAoAAAAFgAAAA==eF5jYYAAdijNBaV5obQAlAYAA+gAMw==
  </AppendedData>
</VTKFile>
)file";

// appended as raw bytes, headers of 64 bits
constexpr const char* vtp_appended_raw_base64 =
    "PFZUS0ZpbGUgdHlwZT0iUG9seURhdGEiIHZlcnNpb249IjEuMCIgYnl0ZV9vcmRlcj0iTGl0dGxlRW5kaWFuIiBoZWFkZXJfdHlw"
    "ZT0iVUludDY0Ij4KPFBvbHlEYXRhPgo8RmllbGREYXRhPgo8QXJyYXkgdHlwZT0iU3RyaW5nIiBOYW1lPSJTUEFDRSIgTnVtYmVy"
    "T2ZUdXBsZXM9IjEiIGZvcm1hdD0iYXBwZW5kZWQiIG9mZnNldD0iMCIvPjwvRmllbGREYXRhPgo8UGllY2UgTnVtYmVyT2ZQb2lu"
    "dHM9IjUiIE51bWJlck9mVmVydHM9IjAiIE51bWJlck9mTGluZXM9IjEiIE51bWJlck9mU3RyaXBzPSIwIiBOdW1iZXJPZlBvbHlz"
    "PSI1Ij4KPFBvaW50RGF0YSBTY2FsYXJzPSJSR0IiIE5vcm1hbHM9Ik5vcm1hbHMiIFRDb29yZHM9IlRDb29yZHMiPgo8RGF0YUFy"
    "cmF5IHR5cGU9IlVJbnQ4IiBOYW1lPSJSR0IiIE51bWJlck9mQ29tcG9uZW50cz0iMyIgZm9ybWF0PSJhcHBlbmRlZCIgb2Zmc2V0"
    "PSIxMiI+PC9EYXRhQXJyYXk+CjxEYXRhQXJyYXkgdHlwZT0iRmxvYXQzMiIgTmFtZT0iVENvb3JkcyIgTnVtYmVyT2ZDb21wb25l"
    "bnRzPSIyIiBmb3JtYXQ9ImFwcGVuZGVkIiBvZmZzZXQ9IjM1Ij48L0RhdGFBcnJheT4KPERhdGFBcnJheSB0eXBlPSJGbG9hdDMy"
    "IiBOYW1lPSJOb3JtYWxzIiBOdW1iZXJPZkNvbXBvbmVudHM9IjMiIGZvcm1hdD0iYXBwZW5kZWQiIG9mZnNldD0iODMiPjwvRGF0"
    "YUFycmF5Pgo8RGF0YUFycmF5IHR5cGU9IkZsb2F0NjQiIE5hbWU9Im15IGN1cnZhdHVyZSIgZm9ybWF0PSJhcHBlbmRlZCIgb2Zm"
    "c2V0PSIxNTEiPjwvRGF0YUFycmF5Pgo8RGF0YUFycmF5IHR5cGU9IkJpdCIgTmFtZT0iYml0cyIgZm9ybWF0PSJhcHBlbmRlZCIg"
    "b2Zmc2V0PSIxOTkiPjwvRGF0YUFycmF5PjwvUG9pbnREYXRhPgo8Q2VsbERhdGE+CjxEYXRhQXJyYXkgdHlwZT0iSW50NjQiIElk"
    "VHlwZT0iMSIgTmFtZT0ibGFiZWwiIGZvcm1hdD0iYXBwZW5kZWQiIG9mZnNldD0iMjA4Ij48L0RhdGFBcnJheT48L0NlbGxEYXRh"
    "Pgo8UG9pbnRzPgo8RGF0YUFycmF5IHR5cGU9IkZsb2F0MzIiIE5hbWU9IlBvaW50cyIgTnVtYmVyT2ZDb21wb25lbnRzPSIzIiBm"
    "b3JtYXQ9ImFwcGVuZGVkIiBvZmZzZXQ9IjI2NCI+PC9EYXRhQXJyYXk+PC9Qb2ludHM+CjxMaW5lcz4KPERhdGFBcnJheSB0eXBl"
    "PSJJbnQ2NCIgTmFtZT0iY29ubmVjdGl2aXR5IiBmb3JtYXQ9ImFwcGVuZGVkIiBvZmZzZXQ9IjM0OCIvPgo8RGF0YUFycmF5IHR5"
    "cGU9IkludDY0IiBOYW1lPSJvZmZzZXRzIiBmb3JtYXQ9ImFwcGVuZGVkIiBvZmZzZXQ9IjM3MiIvPjwvTGluZXM+CjxQb2x5cz4K"
    "PERhdGFBcnJheSB0eXBlPSJJbnQ2NCIgTmFtZT0iY29ubmVjdGl2aXR5IiBmb3JtYXQ9ImFwcGVuZGVkIiBvZmZzZXQ9IjQwNCIv"
    "Pgo8RGF0YUFycmF5IHR5cGU9IkludDY0IiBOYW1lPSJvZmZzZXRzIiBmb3JtYXQ9ImFwcGVuZGVkIiBvZmZzZXQ9IjU0MCIvPjwv"
    "UG9seXM+PC9QaWVjZT48L1BvbHlEYXRhPgo8QXBwZW5kZWREYXRhIGVuY29kaW5nPSJyYXciPgogICBfBAAAAAAAAABMUFMADwAA"
    "AAAAAAD/AAAA/wAAAP8DBAX///8oAAAAAAAAAAAAAAAAAAAAAACAPwAAAAAAAIA/AACAPwAAAAAAAIA/AAAAPwAAAD88AAAAAAAA"
    "AHVfmz7rCV2/rlPOPmnmKz9p5iu/cHWgPn+/Zz8eHMU+mf03PmnmK79p5is/cHWgPgAAAAAAAAAAAACAPygAAAAAAAAAAAAAAAAA"
    "+D8AAAAAAAAEQAAAAAAAAPh/AAAAAAAAEEAAAAAAAAAUQAEAAAAAAAAAUDAAAAAAAAAAAAAAAAAAAAABAAAAAAAAAAIAAAAAAAAA"
    "AwAAAAAAAAAEAAAAAAAAAAUAAAAAAAAAPAAAAAAAAAAAAAAAAAAAAAAAAAAAAABAAAAAAAAAAAAAAABAAAAAQAAAAAAAAAAAAAAA"
    "QAAAAAAAAIA/AACAP83MjD8AAAAAAAAAAAAAAAAAAAAAEAAAAAAAAAAAAAAAAAAAAAIAAAAAAAAACAAAAAAAAAACAAAAAAAAAAAA"
    "AAAAAAAAAAAAAAAAAACAAAAAAAAAAAAAAAAAAAAAAwAAAAAAAAACAAAAAAAAAAEAAAAAAAAAAAAAAAAAAAABAAAAAAAAAAQAAAAA"
    "AAAAAQAAAAAAAAACAAAAAAAAAAQAAAAAAAAAAgAAAAAAAAADAAAAAAAAAAQAAAAAAAAAAwAAAAAAAAAAAAAAAAAAAAQAAAAAAAAA"
    "KAAAAAAAAAAEAAAAAAAAAAcAAAAAAAAACgAAAAAAAAANAAAAAAAAABAAAAAAAAAACiAgPC9BcHBlbmRlZERhdGE+CjwvVlRLRmls"
    "ZT4K";

// compressed, in base64, big-endian, headers of 64 bits
constexpr const char* vtp_inline_big_endian =
    R"file(<VTKFile type="PolyData" version="1.0" byte_order="BigEndian" header_type="UInt64" compressor="vtkZLibDataCompressor">
<PolyData>
<FieldData>
<Array type="String" Name="SPACE" NumberOfTuples="1" format="binary">AAAAAAAAAAEAAAAAAACAAAAAAAAAAAAEAAAAAAAAAAw=eF7zCQhmAAACygDw</Array></FieldData>
<Piece NumberOfPoints="5" NumberOfVerts="0" NumberOfLines="1" NumberOfStrips="0" NumberOfPolys="5">
<PointData Scalars="RGB" Normals="Normals" TCoords="TCoords">
<DataArray type="UInt8" Name="RGB" NumberOfComponents="3" format="binary">AAAAAAAAAAEAAAAAAACAAAAAAAAAAAAPAAAAAAAAABU=eF77z8DA8B+EmVlY////DwAnIgYH</DataArray>
<DataArray type="Float32" Name="TCoords" NumberOfComponents="2" format="binary">AAAAAAAAAAEAAAAAAACAAAAAAAAAAAAoAAAAAAAAABM=eF5jYIAA+wYEjcJmgGAAQsQDew==</DataArray>
<DataArray type="Float32" Name="Normals" NumberOfComponents="3" format="binary">AAAAAAAAAAEAAAAAAACAAAAAAAAAAAA8AAAAAAAAADc=eF6zmx1fuj+W87XdueB19trPMvcDsd2C0gL79P31dkdl5OzM/84EidlDxRmgwL6BgQEANNIXIA==</DataArray>
<DataArray type="Float64" Name="my curvature" format="binary">AAAAAAAAAAEAAAAAAACAAAAAAAAAAAAoAAAAAAAAABg=eF6z/8EABg4sELoexheA0iIQGgBh8AOX</DataArray>
<DataArray type="Bit" Name="bits" format="binary">AAAAAAAAAAEAAAAAAACAAAAAAAAAAAABAAAAAAAAAAk=eF4LAAAAUQBR</DataArray></PointData>
<CellData>
<DataArray type="Int64" IdType="1" Name="label" format="binary">AAAAAAAAAAEAAAAAAACAAAAAAAAAAAAwAAAAAAAAABc=eF5jYEABjFCaCUozQ2kWKM0KAADfABA=</DataArray></CellData>
<Points>
<DataArray type="Float32" Name="Points" NumberOfComponents="3" format="binary">AAAAAAAAAAEAAAAAAACAAAAAAAAAAAA8AAAAAAAAABg=eF5jYEAABzQ2Oh8E7BuguOfMWQA1LQTj</DataArray></Points>
<Lines>
<DataArray type="Int64" Name="connectivity" format="binary">AAAAAAAAAAEAAAAAAACAAAAAAAAAAAAQAAAAAAAAAAw=eF5jYEABTAAAEgAD</DataArray>
<DataArray type="Int64" Name="offsets" format="binary">AAAAAAAAAAEAAAAAAACAAAAAAAAAAAAIAAAAAAAAAAw=eF5jYAADJgAACgAD</DataArray></Lines>
<Polys>
<DataArray type="Int64" Name="connectivity" format="binary">AAAAAAAAAAEAAAAAAACAAAAAAAAAAACAAAAAAAAAACY=eF5jYEABzFCaCUozokrD+SxofJh6mDiMDzMPJg7jwwALAAdCACM=</DataArray>
<DataArray type="Int64" Name="offsets" format="binary">AAAAAAAAAAEAAAAAAACAAAAAAAAAAAAoAAAAAAAAABg=eF5jYAADFgjFwA6luaA0L5QWAAACigAz</DataArray></Polys></Piece></PolyData></VTKFile>
)file";

// text
constexpr const char* vtp_text =
    R"file(<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian" header_type="UInt32">
<PolyData>
<FieldData>
<Array type="String" Name="SPACE" NumberOfTuples="1" format="ascii">76 80 83 0</Array></FieldData>
<Piece NumberOfPoints="5" NumberOfVerts="0" NumberOfLines="1" NumberOfStrips="0" NumberOfPolys="5">
<PointData Scalars="RGB" Normals="Normals" TCoords="TCoords">
<DataArray type="UInt8" Name="RGB" NumberOfComponents="3" format="ascii">255 0 0 0 255 0
          0 0 255 3 4 5
          255 255 255</DataArray>
<DataArray type="Float32" Name="TCoords" NumberOfComponents="2" format="ascii">0 0 1 0 1 1
          0 1 0.5 0.5</DataArray>
<DataArray type="Float32" Name="Normals" NumberOfComponents="3" format="ascii">0.30346265 -0.8634326 0.40298218 0.67148453 -0.67148453 0.31339598
          0.90526575 0.38498014 0.17967834 -0.67148453 0.67148453 0.31339598
          0 0 1</DataArray>
<DataArray type="Float64" Name="my curvature" format="ascii">1.5 2.5 nan 4 5</DataArray>
<DataArray type="Bit" Name="bits" format="ascii">0 1 0 1 0</DataArray></PointData>
<CellData>
<DataArray type="Int64" IdType="1" Name="label" format="ascii">0 1 2 3 4 5</DataArray></CellData>
<Points>
<DataArray type="Float32" Name="Points" NumberOfComponents="3" format="ascii">0 0 0 2 0 0
          2 2 0 0 2 0
          1 1 1.1</DataArray></Points>
<Lines>
<DataArray type="Int64" Name="connectivity" format="ascii">0 2</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">2</DataArray></Lines>
<Polys>
<DataArray type="Int64" Name="connectivity" format="ascii">0 3 2 1 0 1
          4 1 2 4 2 3
          4 3 0 4</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">4 7 10 13 16</DataArray></Polys></Piece></PolyData></VTKFile>
)file";

} // namespace meshtween
