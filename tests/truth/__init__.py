"""What the library is held against, shared by the tests, the checks of the claims and the benchmarks.

Oracles import nothing of the library: `rational` (the plane in fractions), `medial` (unions of balls by brute
force), `meshes` (cubes by hand). `solids` and `cases` set the library's own things beside them.
"""
