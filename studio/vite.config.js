// One script and one style sheet with fixed names: the command embeds them.
export default {
  build: {
    outDir: "dist",
    emptyOutDir: true,
    modulePreload: false,
    target: "es2022",
    // Read from this machine, not over a network.
    chunkSizeWarningLimit: 2000,
    rollupOptions: {
      output: {
        entryFileNames: "studio.js",
        assetFileNames: "studio[extname]",
        inlineDynamicImports: true,
      },
    },
  },
};
