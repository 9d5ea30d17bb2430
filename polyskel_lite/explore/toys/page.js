// Explorers and questions on a page without a kernel.

export default {};
