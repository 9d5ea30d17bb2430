// node tests/project/in_pyodide.mjs PYODIDE WHEEL SCRIPT: runs a Python script on the library's wheel in Pyodide.
import { readFileSync } from "node:fs";
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";

const [folder, wheel, script] = process.argv.slice(2);
const { loadPyodide } = await import(pathToFileURL(resolve(folder, "pyodide.mjs")).href);
const python = await loadPyodide({ indexURL: resolve(folder) + "/" });
await python.loadPackage(["numpy", "scipy", "matplotlib"], { messageCallback: () => {} });
python.unpackArchive(new Uint8Array(readFileSync(wheel)), "wheel");
try {
    python.runPython(readFileSync(script, "utf8"));
} catch (error) {
    console.error(error.message);
    process.exit(1);
}
