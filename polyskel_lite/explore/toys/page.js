// Explorers and questions on a page without a kernel.

import { predictions } from "./predict.js";

if (typeof document !== "undefined") predictions();

export default {};
