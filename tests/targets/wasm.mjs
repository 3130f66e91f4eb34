// node wasm.mjs MODULE: runs the module, and prints what it says.
import { readFileSync } from "node:fs";

const said = [];
const env = { put: (byte) => said.push(byte) };
const module = new WebAssembly.Module(readFileSync(process.argv[2]));
const names = WebAssembly.Module.imports(module).map((i) => `${i.module}.${i.name}`);
if (names.join() !== "env.put") throw new Error(`the module imports ${names.join(", ")}`);
const status = new WebAssembly.Instance(module, { env }).exports.report();
process.stdout.write(Buffer.from(said));
process.exit(status);
