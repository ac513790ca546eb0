// How the tests start Chromium: without a display, a network or graphics hardware.

export const chromium = process.env.CHROMIUM ?? '/usr/bin/chromium';

const disabledFeatures = [
  // Two pages below the address bar, which nothing shows here: each window would make them, in a third of the time that a page of ours takes.
  'WebUIOmniboxPopup', 'WebUIOmniboxAimPopup',
  // What Playwright disables: this option counts once.
  'AcceptCHFrame', 'AvoidUnnecessaryBeforeUnloadCheckSync', 'DestroyProfileOnBrowserClose', 'DialMediaRouteProvider', 'GlobalMediaControls',
  'HttpsUpgrades', 'LensOverlay', 'MediaRouter', 'PaintHolding', 'ThirdPartyStoragePartitioning', 'Translate', 'AutoDeElevate',
];

/** For Playwright's `launch`. */
export const launchOptions = {
  executablePath: chromium,
  args: [
    '--no-sandbox', '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-quic', '--disable-sync',
    '--disable-dev-shm-usage', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
    '--disable-gpu-compositing', // Drawing the page itself that way takes a fifth of a test's time.
    `--disable-features=${disabledFeatures.join(',')}`,
    // Smooth edges are for people who look at the pictures; four samples for each pixel take time.
    ...(process.env.ISOCNC_SCREENSHOTS ? [] : ['--webgl-antialiasing-mode=none']),
  ],
};
