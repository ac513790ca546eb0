import eslint from "@eslint/js";
import globals from "globals";
import typescript from "typescript-eslint";

/// What may surprise in TypeScript: every rule of the two recommended sets that judges by types, and none by looks.
export default typescript.config(
  { ignores: ["dist/", "node_modules/"] },
  {
    files: ["src/**/*.ts"],
    extends: [eslint.configs.recommended, typescript.configs.strictTypeChecked],
    languageOptions: { parserOptions: { projectService: true } },
    rules: {
      // Numbers go into texts as they are.
      "@typescript-eslint/restrict-template-expressions": ["error", { allowNumber: true }],
      // `() => nothing()` is how a listener is written.
      "@typescript-eslint/no-confusing-void-expression": ["error", { ignoreArrowShorthand: true, ignoreVoidReturningFunctions: true }],
      // What an index finds has the type of the elements: nothing but the code knows whether it is there.
      "@typescript-eslint/no-unnecessary-condition": "off",
      "@typescript-eslint/no-non-null-assertion": "off",
      // A vscode.Disposable is whatever has a dispose().
      "@typescript-eslint/no-unsafe-class-instance-assignment": "off",
    },
  },
  // What builds and tests; some of it runs in pages that are opened for that.
  {
    files: ["**/*.mjs"],
    extends: [eslint.configs.recommended],
    languageOptions: { globals: { ...globals.node, ...globals.browser } },
  },
);
