// One script and one style sheet with fixed names: the command embeds them.
export default {
  build: {
    outDir: "dist",
    emptyOutDir: true,
    modulePreload: false,
    target: "es2022",
    rollupOptions: {
      output: {
        entryFileNames: "studio.js",
        assetFileNames: "studio[extname]",
        inlineDynamicImports: true,
      },
    },
  },
};
