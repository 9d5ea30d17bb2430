"""What the library is held against, shared by the tests, the checks of the claims and the benchmarks.

Oracles: `rational` (the plane in fractions), `space` (the same for space), `medial` and `nerves` (unions of
balls by brute force), `complexes` (distances). Things to try: `points`, `meshes`, `polyballs`. None of these
imports the library.
`solids` are made by it, `cases` set it beside the truth.
"""
