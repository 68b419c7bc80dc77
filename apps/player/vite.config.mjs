// Builds the player into one HTML file that loads nothing.
import { defineConfig } from 'vite';

// Moves the bundle's script and style into the page.
function inlineEverything() {
    return {
        name: 'inline-everything',
        enforce: 'post',
        generateBundle(_options, bundle) {
            const page = bundle['index.html'];
            for (const [name, file] of Object.entries(bundle)) {
                if (file === page) continue;
                const code = file.type === 'chunk' ? file.code : String(file.source);
                const tag = name.endsWith('.css')
                    ? new RegExp(`<link[^>]*href="[^"]*${name}"[^>]*>`)
                    : new RegExp(`<script[^>]*src="[^"]*${name}"[^>]*></script>`);
                const inlined = name.endsWith('.css')
                    ? `<style>${code}</style>`
                    : `<script type="module">${code.replaceAll('</script', '<\\/script')}</script>`;
                if (!tag.test(page.source)) throw new Error(`the page does not load ${name}`);
                page.source = page.source.replace(tag, () => inlined);
                delete bundle[name];
            }
        },
    };
}

export default defineConfig({
    base: './',
    plugins: [inlineEverything()],
    build: {
        target: 'es2022',
        modulePreload: false,
        cssCodeSplit: false,
        assetsInlineLimit: Number.MAX_SAFE_INTEGER,
        chunkSizeWarningLimit: 2000,
        rollupOptions: { output: { inlineDynamicImports: true } },
    },
});
