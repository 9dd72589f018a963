// The boat: a small lugger of varnished wood in a bay of clear water, or out in a gale.
//
// Arrow keys drive her: up and down for speed, left and right for the rudder. She rides the waves
// like a stiff float, leans into the wind, throws a wake, shades the water and the sand below it
// and stands mirrored in the sea. `firstPerson` takes the helm; else the mouse goes round her.
//
// Method   The sea is a height field of twenty directional waves with exact phases; eight long ones
//          move it, twelve tilt it. All wave numbers fit a square of 480 m, after which the world
//          repeats, and all is drawn round the boat: no digits are lost however far she sails.
//          Rays meet the sea by steps that its slope bounds. Waves finer than a pixel widen the
//          sun's lobe instead. Heave, pitch and roll are damped oscillators driven by the waves
//          under the hull; a step solves them in closed form, for a force that is linear in it. The
//          hull is an ellipse at each station; rays march its bound. Her wake is a wave equation
//          with foam on a torus of cells round her. Light on the sand: its place of entry by
//          fixed-point steps, then 1/|J|; from there it may still meet the boat.
// Sources  Juckett, Damped Springs (2012), and Hochbruck and Ostermann, Acta Numerica 19 (2010):
//          exponential steps. Bruneton, Neyret, Holzschuch, CGF 29 (2010): filtered glitter. Hart,
//          Visual Computer 12 (1996): sphere tracing. Courant, Friedrichs, Lewy, Math. Ann. 100
//          (1928): stability. Nishita et al., SIGGRAPH (1993): sky. Kasten and Young, Appl. Opt. 28
//          (1989): air mass. Born and Wolf, Principles of Optics, 1.5: Fresnel. Jarzynski and
//          Olano, JCGT 9(3) (2020): pcg3d.
// Units    1 unit = 1 m, y up, 0 the water at rest, the boat at x = z = 0; linear sRGB colour, noon
//          sun 10. In the boat's frame x is to port, y up, z forward.
// Passes   air, sky, motif: on change of a tweak; screen: only its size counts. boat, wake: the
//          simulation, 240 a second.
//          Every frame: wavelets, poses (tiny), relief (the wake's slopes), the picture.
// Bounds   Slopes of the long waves sum to 0.95. The loops of a pixel stay below 45,000 turns.
// Defaults From `glint study presets/boat.toml`: boatSteps 128 draw what 256 do, in the time of 64.
//          seaSteps 64 would do; at 1.5 degrees 192 leave no more than 0.1 % of the rays out of
//          steps in any gale. The cone of shadow is 0.011 (RMSE) from sampled ones, in two thirds
//          of the frame; one substep is 6e-4 from 64.
// Licence  MIT

// ---- Tweaks -------------------------------------------------------------------------------------
//@ group Boat
uniform bool  firstPerson;     //@ off "the eye at the helm"
uniform float topSpeed;        //@ 3.0 [0.5, 7] unit=m/s "at full throttle"
uniform float turnRate;        //@ 34 [5, 90] unit=deg/s "at full rudder and top speed"
uniform float startHeading;    //@ 0 [-180, 180] unit=deg "at time 0"
uniform float stiffness;       //@ 26 [0.001, 100000] log unit=1/s2 "how hard the sea holds her"
uniform float damping;         //@ 3.6 [0, 1000] unit=1/s "how soon she comes to rest"
uniform bool  sail;            //@ on "hoisted; it trims itself"
uniform vec3  hullColour;      //@ #f2ede0 "of the planks"
uniform vec3  sailColour;      //@ #a5432a "of the cloth"
uniform bool  reflection;      //@ on "of the boat in the water"
uniform float wakeStrength;    //@ 1.0 [0, 3] "waves and foam that she leaves"
//@ group Sea
uniform float depth;           //@ 2.4 [0.8, 40] log unit=m "of the water over the sand"
uniform float longestWave;     //@ 4.5 [1.5, 40] log unit=m "crest to crest"
uniform float steepness;       //@ 0.26 [0, 1] "of the long waves; 1 is a gale"
uniform float choppiness;      //@ 0.5 [0, 1] "sharpness of their crests"
uniform float ripples;         //@ 0.6 [0, 2] "steepness of the short waves"
uniform float windAngle;       //@ 50 [-180, 180] unit=deg "where wind and waves go; 0 is ahead"
uniform vec3  waterTint;       //@ #7dcade "what 3 m of water leave of white light"
uniform vec3  deepColour;      //@ #08546c "what deep water scatters back"
uniform float floorShare;      //@ 1.0 [0, 1] "of the sand in the water; 1 is physical, 0 hides it"
uniform float caustics;        //@ 1.0 [0, 1] "light gathered by the waves; 0 is even light"
uniform float foam;            //@ 0.5 [0, 1] "on breaking crests and in the wake"
uniform float animation;       //@ 1.0 [0, 2] "speed of waves and rain"
//@ group Weather
uniform float sunHeight;       //@ 46 [0, 80] unit=deg "over the horizon"
uniform float sunAngle;        //@ -118 [-180, 180] unit=deg "to the right of the way she starts"
uniform float sunSize;         //@ 0.27 [0.1, 3] log unit=deg "radius of the sun's disc"
uniform float haze;            //@ 1.0 [0.1, 6] log "dust in the air"
uniform float clouds;          //@ 0.75 [0, 1] "how much of the sky they cover"
uniform float overcast;        //@ 0.0 [0, 1] "a grey lid over everything"
uniform float rain;            //@ 0.0 [0, 1] "streaks, and rings on the water"
uniform float visibility;      //@ 9000 [60, 30000] log unit=m "where 63 % of the light is air"
//@ group Camera
uniform float cameraDistance;  //@ 8.5 [3, 40] unit=m "from the boat, level"
uniform float cameraAngle;     //@ -60 [-180, 180] unit=deg "round it; 0 is astern"
uniform float cameraHeight;    //@ 3.0 [0.3, 20] unit=m "of the eye, and never inside a wave"
uniform float targetHeight;    //@ 1.0 [-2, 5] unit=m "of the point looked at"
uniform float targetShift;     //@ 0.0 [-8, 8] unit=m "of the point looked at, to the right"
uniform bool  chase;           //@ on "the camera turns with the boat"
uniform float steadiness;      //@ 0.5 [0, 1] "of the head at the helm; 0 moves as the deck does"
uniform float focalLength;     //@ 28 [12, 120] log unit=mm "of a lens on 36 x 24 mm film"
uniform float exposure;        //@ -0.8 [-6, 6] unit=stop "before the display curve"
//@ group Quality
uniform int   integrator; //@ 2 {explicit, semi-implicit, exact} safe=[2, 2] quality reference=2 second=semi-implicit,substeps=64 "of the float"
uniform int   substeps;        //@ 1 [1, 64] log quality reference=64 "of the float in 1/240 s"
uniform int   seaSteps;        //@ 192 [8, 512] log quality reference=512 "of a ray to the sea"
uniform int   boatSteps;       //@ 128 [16, 256] log quality reference=256 "of a ray to the boat"
uniform int   shadows;         //@ 1 {off, cone, sampled} quality reference=2 "kind of shadow"
uniform int   sunSamples;      //@ 8 [1, 32] log quality reference=32 "rays of a sampled shadow"
uniform int   antialias;       //@ 1 [1, 8] log quality reference=8 "rays through a pixel"

precision highp sampler2D;     // the default is lowp: Mesa then reads 32-bit buffers as halves
uniform sampler2D keys;        //@ keyboard
uniform sampler2D air;         //@ pass mainAir size=64x128
uniform sampler2D sky; //@ pass mainSky size=2048x512 format=rgba16f wrap=repeat filter=mipmap
uniform sampler2D boat;        //@ pass mainBoat size=5x1 step=1/240 filter=nearest
uniform sampler2D wake;        //@ pass mainWake size=48x192 step=1/240 wrap=repeat filter=nearest bounded=[-0.41, 0.41]
uniform sampler2D wakeRise;    //@ pass mainWake size=48x192 step=1/240 wrap=repeat filter=nearest bounded=[-8, 8]
uniform sampler2D wakeFoam;    //@ pass mainWake size=48x192 step=1/240 wrap=repeat filter=nearest bounded=[0, 1]
uniform sampler2D wavelets;    //@ pass mainWavelets size=23x1 filter=nearest
uniform sampler2D screen;      //@ pass mainScreen format=r8
uniform sampler2D poses;       //@ pass mainPoses size=8x1 filter=nearest
uniform sampler2D motif; //@ pass mainMotif size=512x512 format=rgba8 wrap=repeat filter=mipmap
uniform sampler2D relief;      //@ pass mainRelief size=192x192 wrap=repeat filter=linear

// ---- Constants and numbers ----------------------------------------------------------------------
// All waves fit a square of kWorld, so that the world repeats after it, and all is drawn round the
// boat: coordinates stay small, and floats fine, however far she sails.

const float kPi = 3.14159265358979;
const float kGolden = 0.61803398874989;    // turns between neighbours of a phyllotaxis
const float kFar = 1e9;                    // m, a miss
const float kGravity = 9.81;               // m/s^2
const float kIorWater = 1.333;             // visible light, 20 C
const float kCalmSpread = 0.0009;          // slope variance of capillary waves, always unresolved
const float kWorld = 480.0;                // m, side of the square after which all repeats
const float kWindow = 24.0;                // m, side of the wake's torus; divides kWorld
const float kWakeSpeed = 1.25;             // m/s, of her waves; 0.04 of a cell in a step
const float kBow = 2.30, kStern = -2.10;   // m, z at the ends of the hull
const float kDeckEnd = 1.25, kAfterDeck = -1.66, kBottom = -0.12;   // m, the well: z, z, y
const float kMastAt = 0.46, kMastTop = 4.15;            // m, z and y
const float kTack = 0.95, kHead = 3.95, kChord = 1.95;  // m, the sail: y, y, length along the boom
const int   kWater = -1, kNone = 0, kPlanks = 1, kWell = 2, kDeck = 3, kRail = 4, kThwart = 5;
const int   kSpar = 6, kCloth = 7, kRudder = 8, kSand = 9;
// Slopes of the eight long waves at steepness 1; with their harmonics they sum to 0.95 at most.
const float kSteep[8] = float[8](0.072, 0.090, 0.102, 0.102, 0.102, 0.096, 0.090, 0.076);

// q: in the boat's frame; room: before it, 2 where nothing is near.
struct Hit { float t; int part; vec3 nor, q; float room; };
// spread: lost slope variance xx, zz, xz; tails: how much longer than a Gaussian's its tails are.
struct Sea { float height; vec2 slope; vec3 spread; float tails; };
struct Eye { vec3 pos, right, up, forward; float lens; };

uvec3 hash3(ivec3 q) {
    uvec3 v = uvec3(q) * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> 16u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    return v;
}
vec3 random3(ivec3 q) { return vec3(hash3(q) >> 8u) / 16777216.0; }
// A texel of a buffer that `filter=nearest` reads, from its place and how many there are; half the
// price of texelFetch on llvmpipe.
vec4 fetch(sampler2D buffer, vec2 place, vec2 texels) {
    return textureLod(buffer, (place + 0.5) / texels, 0.0);
}

// Cycles since the start, modulo 1, of a motion; its frequency is cut to a multiple of 1/65536 Hz.
float cycles(float hz) { return float(uint(hz * animation * 65536.0) * iTick) / 4294967296.0; }
// 0, which compilers cannot know: a loop that starts there is not unrolled, and compiled sooner.
int loopStart() { return min(0, int(iSampleRate)); }

vec2 turn(vec2 p, float angle) {
    float c = cos(angle), s = sin(angle);
    return vec2(c * p.x + s * p.y, c * p.y - s * p.x);
}
float maxComponent(vec3 v) { return max(v.x, max(v.y, v.z)); }
float square(float x) { return x * x; }
vec3 linearColour(vec3 c) {   // from sRGB, a fit to 1/500
    return c * (c * (c * 0.305306011 + 0.682171111) + 0.012522878);
}

// Reflected share of unpolarised light, exact; eta: index beyond over index before the surface.
float fresnel(float cosI, float eta) {
    float gg = (eta - 1.0) * (eta + 1.0) + cosI * cosI;
    if (gg <= 0.0) return 1.0;
    float g = sqrt(gg);
    float a = (g - cosI) / max(g + cosI, 1e-9);
    float b = (cosI * (g + cosI) - 1.0) / (cosI * (g - cosI) + 1.0);
    return min(0.5 * a * a * (1.0 + b * b), 1.0);
}

vec3 safeInverse(vec3 rd) {   // never infinite, so a slab never multiplies 0 by infinity
    return 1.0 / mix(rd, vec3(1e-20), lessThan(abs(rd), vec3(1e-20)));
}

// Coverage of a pixel of width w, centred at x, by lines of half-width h at every integer.
float lines(float x, float h, float w) {
    w = max(w, 1e-4);
    float a = x - 0.5 * w, b = x + 0.5 * w;
    vec2 whole = floor(vec2(a, b) + 0.5), part = clamp(vec2(a, b) - whole, -h, h);
    return clamp((2.0 * h * (whole.y - whole.x) + part.y - part.x) / w, 0.0, 1.0);
}

vec4 previousFrame(vec4 p) {   // NaN compares false
    return mix(vec4(0.0), p, lessThanEqual(abs(p), vec4(6e4)));
}

float tiledNoise(vec2 unit, ivec2 period, int seed) {   // value noise on a torus
    vec2 p = unit * vec2(period), f = fract(p), s = f * f * (3.0 - 2.0 * f);
    ivec2 a = ivec2(p) % period, b = (a + 1) % period;   // unit in [0, 1)
    return mix(mix(random3(ivec3(a, seed)).x, random3(ivec3(b.x, a.y, seed)).x, s.x),
               mix(random3(ivec3(a.x, b.y, seed)).x, random3(ivec3(b, seed)).x, s.x), s.y);
}

vec3 absorption() { return -log(clamp(linearColour(waterTint), 0.002, 0.998)) / 3.0; }   // 1/m
vec3 sunDirection() {
    float a = radians(sunAngle), h = radians(sunHeight);
    return vec3(sin(a) * cos(h), sin(h), -cos(a) * cos(h));
}
// Irradiance of the sun over pi, facing it, for a lamp of 1 above the air.
vec3 sunColour() {
    float h = max(sunHeight, -2.0);
    float mass = 1.0 / (max(sin(radians(h)), 0.0) + 0.15 * pow(h + 3.885, -1.253));
    vec3 tau = vec3(0.042, 0.098, 0.24) + vec3(0.030, 0.036, 0.044) * haze;
    return 10.0 * smoothstep(-1.0, 1.5, sunHeight) * exp(-tau * mass);
}
// Fog lies 150 m deep on the sea where one sees less than 900 m: its optical depth straight up.
float fogAbove() { return max(150.0 / visibility - 1.0 / 6.0, 0.0); }
float throughFog(float up) { return exp(-min(fogAbove() / max(up, 0.01), 60.0)); }
vec3 sunLight() {
    return sunColour() * (square(1.0 - overcast) * throughFog(sunDirection().y));
}
vec3 sunBleached() { return mix(sunLight(), vec3(maxComponent(sunLight())), 0.3); }   // as on film

// ---- The float ----------------------------------------------------------------------------------
// Heave, pitch and roll are each a weight on a damped spring, whose free end the waves move:
// x'' + c x' + k x = k f(t). Small steps of x and x' in turn explode once k t^2 passes about 4.
// But with f a straight line during the step the equation has a solution in closed form (Juckett;
// Hochbruck and Ostermann): it is exact for any stiffness, damping and length of step.

float meanDecay(float x) {   // (1 - exp(-x)) / x, x >= 0
    return x < 0.02 ? 1.0 - x * 0.5 * (1.0 - x / 3.0 * (1.0 - x * 0.25))
        : (1.0 - exp(-min(x, 80.0))) / x;
}
// x'' + c x' + k x = k f over a step of t, for f from f0 to f1 on a line; s: x and x'.
// S is the answer to a push, k Q to a constant f, R to f = t. No difference of nearly equal numbers
// is divided by anything small, whatever k, c and t are.
vec2 floatExactly(vec2 s, float k, float c, float t, float f0, float f1) {
    float a = 0.5 * c, gap = a * a - k, w = sqrt(abs(gap)), S, Q, R;
    if (c * t < 0.1 && k * t * t < 0.01) {   // series
        S = t * (1.0 - 0.5 * c * t + (c * c - k) * t * t / 6.0
                 - c * (c * c - 2.0 * k) * t * t * t / 24.0);
        Q = t * t * (0.5 - c * t / 6.0 + (c * c - k) * t * t / 24.0);
        R = k * t * t * t * (1.0 / 6.0 - c * t / 24.0 + (c * c - k) * t * t / 120.0);
    } else if (gap < 0.0) {   // it swings
        float fade = exp(-min(a * t, 80.0)), wt = w * t;
        float sinc = wt < 0.01 ? 1.0 - wt * wt / 6.0 : sin(wt) / wt;
        S = fade * t * sinc;
        Q = (1.0 - fade * (cos(wt) + a * t * sinc)) / k;
        R = t - S - c * Q;
    } else {                  // it creeps: rates a - w, without cancellation, and a + w
        float fast = a + w, slow = k / max(fast, 1e-20), fade = exp(-min(slow * t, 80.0));
        S = t * fade * meanDecay(2.0 * w * t);
        Q = (t * meanDecay(slow * t) - S) / max(fast, 1e-20);
        R = t - S - c * Q;
    }
    // What is added, small beside x, is rounded; a factor near 1 would be rounded alike each time.
    float push = (f1 - f0) / t, away = s.x - f0;
    return s + vec2(s.y * S + push * R - away * k * Q,
                    push * k * Q - away * k * S - s.y * (k * Q + c * S));
}
// The same for f that bends: the line keeps its mean (Simpson's), as the step before, `older` to
// f0, tells. Else a float that swings along with a wave falls short of it.
vec2 floatAlong(vec2 s, float k, float c, float t, float older, float f0, float f1) {
    float bend = (f1 - 2.0 * f0 + older) / 12.0;
    return floatExactly(s, k, c, t, f0 - bend, f1 - bend);
}
vec2 floatStep(vec2 s, float k, float c, float t, float older, float f0, float f1) {
    if (integrator == 2) return floatAlong(s, k, c, t, older, f0, f1);
    float v = s.y + t * (k * (f0 - s.x) - c * s.y);
    return vec2(s.x + t * (integrator == 1 ? v : s.y), v);
}

// ---- The sea ------------------------------------------------------------------------------------
// A height field: a sum of cosines, each a little sharpened by its second harmonic, h(p) = sum a
// (cos x + B cos 2x) with x = k.p - w t, and w^2 = g |k| tanh(|k| depth): long waves run faster,
// and shallow water slows them (Airy, 1845). Phases are counted in whole ticks of `iTick`, so that
// none is lost after a year. A pixel that holds many short waves sees their mean slope, and how
// much slopes differ (the spread), which widens the mirrored sun instead of making it flicker.

// Wave i, of twenty from long to short: wave vector, which fits the world, and amplitude.
vec3 waveOf(int i) {
    float x = float(i), last = longestWave * 0.0722;   // 0.72^8
    float far = i < 8 ? longestWave * pow(0.72, x)
        : last * pow(min(0.07 / last, 0.9), (x - 8.0) / 11.0);
    float aside = 2.0 * fract(x * kGolden + 0.5) - 1.0;
    float a = radians(windAngle + (i < 8 ? 42.0 : 75.0) * aside);
    vec2 k = floor(kWorld / far * vec2(sin(a), -cos(a)) + 0.5) * (2.0 * kPi / kWorld);
    float steep = i < 8 ? steepness * kSteep[i] : 0.042 * ripples;
    return vec3(k, steep / max(sqrt(dot(k, k)), 1e-3));
}
float waveHz(vec2 k) {   // dispersion over this depth
    float n = max(sqrt(dot(k, k)), 1e-3);
    return sqrt(kGravity * n * tanh(min(n * depth, 20.0))) / (2.0 * kPi);
}
float worldPhase(vec2 k, vec2 p) {   // in cycles; whole numbers of waves fit the world
    return fract(floor(k.x * kWorld / (2.0 * kPi) + 0.5) * (p.x / kWorld))
        + fract(floor(k.y * kWorld / (2.0 * kPi) + 0.5) * (p.y / kWorld));
}
float crest() { return 0.25 * choppiness; }   // second harmonic; over 1/4 a wave has two crests
// Steepest descent of cos x + B cos 2x, B = crest() <= 1/4: of sin x (1 + b cos x) with b = 4 B, it
// is where cos x = c solves 2 b c^2 + c = b.
float steepestShape() {
    float b = 4.0 * crest(), c = 2.0 * b / (sqrt(1.0 + 8.0 * b * b) + 1.0);
    return sqrt(1.0 - c * c) * (1.0 + b * c);
}

// What all rays of a pixel share, fetched once: this frame's waves, with phases at the boat; the
// boat's frame, its place in the world; light from the whole sky.
vec4 gKx[5], gKz[5], gHeight[5], gPhase[5], gLens[3];   // gLens: heights that gather light
mat3 gAxes;
vec2 gPlace;
float gHeave, gBoom, gRudder;
vec3 gAmbient;
void loadWavelets() {
    for (int g = 0; g < 5; ++g) {
        gKx[g] = texelFetch(wavelets, ivec2(4 * g, 0), 0);
        gKz[g] = texelFetch(wavelets, ivec2(4 * g + 1, 0), 0);
        gHeight[g] = texelFetch(wavelets, ivec2(4 * g + 2, 0), 0);
        gPhase[g] = texelFetch(wavelets, ivec2(4 * g + 3, 0), 0);
        if (g < 3) gLens[g] = texelFetch(wavelets, ivec2(20 + g, 0), 0);
    }
}
vec3 loadBoat() {
    vec4 x = texelFetch(poses, ivec2(0, 0), 0), y = texelFetch(poses, ivec2(1, 0), 0);
    vec4 z = texelFetch(poses, ivec2(2, 0), 0), place = texelFetch(poses, ivec2(7, 0), 0);
    gAxes = mat3(x.xyz, y.xyz, z.xyz);
    gHeave = x.w;
    gBoom = y.w;
    gRudder = z.w;
    gPlace = place.xy;
    gAmbient = textureLod(sky, vec2(0.25, 0.6), 7.0).rgb * 0.5
        + textureLod(sky, vec2(0.75, 0.6), 7.0).rgb * 0.5;
    return place.xyz;
}

// Adds four waves, averaged over a Gaussian footprint with covariance blur (xx, zz, xz; m^2): a
// cosine keeps exp(-(k sigma)^2 / 2) of its height, and what its slope loses goes to the spread.
// The value: how much their crests, with some of their backs, are in line, in slope.
float addGroup(int g, vec2 p, vec3 blur, float gain, inout Sea s) {
    vec4 x = gKx[g], z = gKz[g], a = gain * gHeight[g], k2 = x * x + z * z;
    vec4 phase = x * p.x + z * p.y + gPhase[g];
    vec4 keep = exp(-0.5 * (x * x * blur.x + z * z * blur.y + 2.0 * x * z * blur.z));
    vec4 keep2 = keep * keep, harmonic = crest() * keep2 * keep2;
    vec4 c = cos(phase), n = sin(phase), down = a * n * (keep + 4.0 * harmonic * c);
    vec4 lost = 0.5 * a * a * (1.0 - keep2 + 4.0 * (crest() * crest() - harmonic * harmonic));
    s.height += dot(a, keep * c + harmonic * (2.0 * c * c - 1.0));
    s.slope -= vec2(dot(down, x), dot(down, z));
    s.spread += vec3(dot(lost, x * x), dot(lost, z * z), dot(lost, x * z));
    return dot(a * sqrt(k2), keep * (0.86 * c - 0.5 * n));
}
// Ripples come in patches, where gusts touch the water.
float gusts(vec2 world, vec3 blur) {
    float keep = exp(-0.03 * (blur.x + blur.y)), unit = 2.0 * kPi / kWorld;
    float u = sin(unit * (13.0 * world.x + 9.0 * world.y) + 1.7 * sin(unit * 11.0 * world.y)
                  - 2.0 * kPi * cycles(0.14));
    float v = sin(unit * (7.0 * world.x - 16.0 * world.y) - 2.0 * kPi * cycles(0.11));
    return 1.0 + 0.55 * keep * u * v;
}
vec2 inWorld(vec2 p) { return p - kWorld * floor(p / kWorld); }   // none is negative
// Slope of the rings that drops make: one drop in each cell of a square lattice, again and again.
vec2 rainRings(vec2 world, float cell, int seed) {
    vec2 at = inWorld(world) / cell, c = floor(at);
    vec3 r = random3(ivec3(ivec2(c) % int(kWorld / cell + 0.5), seed));
    float age = fract(r.z + cycles(1.25 + 0.5 * floor(4.0 * fract(r.x * 7.0))));
    vec2 d = (at - c - 0.35 - 0.3 * r.xy) * cell;
    float far = max(length(d), 1e-4), ring = (far - 0.33 * cell * age) / 0.012;
    return d / far * (ring * exp(-min(ring * ring, 40.0)) * 0.5 * square(1.0 - age));
}
// Height, slope and lost slopes at a point round the boat; white: how much crests are in line (x),
// foam of the wake (y).
Sea seaAt(vec2 p, vec3 blur, out vec2 white) {
    Sea s = Sea(0.0, vec2(0.0), vec3(kCalmSpread, kCalmSpread, 0.0), 0.0);
    vec2 world = p + gPlace;
    float inLine = addGroup(0, p, blur, 1.0, s) + addGroup(1, p, blur, 1.0, s);
    float gain = gusts(world, blur);
    for (int g = 2; g < 5; ++g) addGroup(g, p, blur, gain, s);
    white = vec2(inLine, 0.0);
    if (wakeStrength > 0.0) {
        vec4 r = textureLod(relief, world / kWindow, 0.0);
        float inside = 1.0 - smoothstep(0.40, 0.47, maxComponent(abs(vec3(p, 0.0))) / kWindow);
        float fade = inside / (1.0 + 6.0 * (blur.x + blur.y));
        s.slope += fade * r.xy;
        white.y = inside * r.z;
    }
    if (rain > 0.0) {
        float keep = exp(-min(4000.0 * (blur.x + blur.y), 60.0));
        vec2 rings = rainRings(world, 0.24, 31) + rainRings(world + 0.11, 0.375, 32);
        s.slope += rain * keep * rings;
        s.spread.xy += rain * (1.0 - keep) * 0.006;
    }
    return s;
}
// Covariance of the footprint on the sea of a pixel of width w that is seen along rd.
vec3 seaFootprint(vec3 rd, float w) {
    float across = square(0.35 * w), along = across / max(square(rd.y), 1e-6) - across;
    vec2 v = rd.xz * inversesqrt(max(dot(rd.xz, rd.xz), 1e-12));
    return vec3(across + along * v * v, along * v.x * v.y);
}
float moversAt(vec2 p) {   // height by the long waves alone
    float h = 0.0;
    for (int g = 0; g < 2; ++g) {
        vec4 c = cos(gKx[g] * p.x + gKz[g] * p.y + gPhase[g]);
        h += dot(gHeight[g], c + crest() * (2.0 * c * c - 1.0));
    }
    return h;
}

// Long waves along a ray: a height is dot(a, cosine(start + rate t)), harmonic included. A wave
// that is lower than half a pixel no longer moves the surface.
struct Movers { vec4 a, start, rate; };
Movers moversOnRay(int g, vec3 ro, vec3 rd, float w) {
    vec4 a = gHeight[g];
    return Movers(a * clamp(4.0 * a / max(w, 1e-6) - 1.0, 0.0, 1.0),
                  gKx[g] * ro.x + gKz[g] * ro.z + gPhase[g], gKx[g] * rd.x + gKz[g] * rd.z);
}
int seaEvaluations = 0;   // of a ray's height over the sea, for measurements
float moversHeight(Movers m, float t) {
    vec4 c = cos(m.start + m.rate * t);
    return dot(m.a, c + crest() * (2.0 * c * c - 1.0));
}
// Spray: wind shears drops off the steepest crests and throws them ahead, where they hang for a
// moment at the crest's height. So it is as dense at a point as the crest kFling upwind of it is
// high, and thins with the height over that crest. A ray keeps the densest that it passes at the
// steps that it takes anyway, which are short where it comes close to a crest.
const float kFling = 1.8;          // m
const float kSprayHeight = 1.0;    // m, over the crest, where the last drops are
vec2 gSpray;   // before what the last ray over the sea met: the densest, 0 to 1, and where, m
float gale() { return smoothstep(0.5, 0.9, steepness) * foam; }
// How far kFling takes the four longest waves on: cosine and sine of their phases' differences.
mat2x4 flung() {
    float a = radians(windAngle);
    vec4 fling = kFling * (gKx[0] * sin(a) - gKz[0] * cos(a));
    return mat2x4(cos(fling), sin(fling));
}
// c, n: cosine and sine of their phases below a point of height y.
void passSpray(Movers m, mat2x4 far, vec4 c, vec4 n, float y, float t) {
    vec4 upwind = c * far[0] + n * far[1];
    float top = dot(m.a, upwind + crest() * (2.0 * upwind * upwind - 1.0));
    float steep = smoothstep(0.25, 0.70, top / max(dot(m.a, vec4(1.0)), 1e-3));
    float dense = steep * square(clamp(1.0 - (y - top) / kSprayHeight, 0.0, 1.0));
    dense *= clamp(0.25 * t - 2.25, 0.0, 1.0);   // none before the eye
    if (dense > gSpray.x) gSpray = vec2(dense, t);
}
// Where a height over the waves is 0, between two places of a ray and their heights: a line through
// both ends tells the next one, and the end that stays halves its gap (Illinois).
float crossing(Movers m0, Movers m1, float from, float fall, vec2 above, vec2 below) {
    float t = below.x;
    for (int k = loopStart(); k < 4; ++k) {
        t = mix(above.x, below.x, clamp(above.y / max(above.y - below.y, 1e-20), 0.02, 0.98));
        float f = from + t * fall - moversHeight(m0, t) - moversHeight(m1, t);
        if (f > 0.0) {
            above = vec2(t, f);
            below.y *= 0.5;
        } else {
            below = vec2(t, f);
            above.y *= 0.5;
        }
    }
    return t;
}
// Where a ray from above meets the sea, or -1. pixel: angle of a pixel, rad. The four longest waves
// have a known slope here and a bounded curvature; the next four are as steep or as high as they
// can be. With a gap f that closes at the speed c and bends by at most b, nothing is met before
// 2 f / (c + sqrt(c^2 + 2 b f)); all waves are rarely at their worst at once, and a fifth more is
// stepped. None is shorter than `least`, which may cut crests that are lower than a millimetre.
float hitWaves(vec3 ro, vec3 rd, float pixel, float tMax) {
    seaEvaluations = 0;
    float reach = pixel * max(ro.y, 0.0) / max(-rd.y, 1e-4);
    Movers m0 = moversOnRay(0, ro, rd, reach), m1 = moversOnRay(1, ro, rd, reach);
    float top1 = (1.0 + crest()) * dot(m1.a, vec4(1.0));
    float top = (1.0 + crest()) * dot(m0.a, vec4(1.0)) + top1 + 1e-4;
    float steep1 = steepestShape() * dot(m1.a, abs(m1.rate));
    float bend0 = 2.0 * (1.0 + 4.0 * crest()) * dot(m0.a, m0.rate * m0.rate);
    float slope = abs(rd.y) < 1e-7 ? -1e-7 : rd.y;
    float enter = max((top - ro.y) / slope, 0.0) * step(top, ro.y);
    float leave = min(((slope < 0.0 ? -top : top) - ro.y) / slope, tMax);
    float most = min(0.0133 * longestWave, 0.12);   // an eighth of the shortest of the eight
    float t = enter, least = min(0.004 + 0.004 * enter, most) + 0.5 * pixel * enter;   // m
    vec2 above = vec2(t, 0.0), below = vec2(-1.0, 0.0);
    bool ahead = enter < leave && (slope < 0.0 || ro.y < top);
    gSpray = vec2(0.0);
    mat2x4 far4 = gale() > 0.0 ? flung() : mat2x4(0.0);
    for (int k = 0; k < seaSteps && ahead; ++k) {
        vec4 phase = m0.start + m0.rate * t, c = cos(phase), n = sin(phase);
        float f0 = ro.y + t * rd.y - dot(m0.a, c + crest() * (2.0 * c * c - 1.0));
        float close0 = -rd.y - dot(m0.a * m0.rate, n * (1.0 + 4.0 * crest() * c));
        float f = f0 - moversHeight(m1, t), close = close0 + steep1, over = max(f0 - top1, 0.0);
        ++seaEvaluations;
        if (gale() > 0.0) passSpray(m0, far4, c, n, ro.y + t * rd.y, t);
        if (f <= 0.0) below = vec2(t, f);
        else above = vec2(t, f);
        ahead = f > 0.0 && t < leave;
        f = max(f, 0.0);
        float far = 2.4 * f / max(close + sqrt(close * close + bend0 * f), 1e-6);
        float far0 = 2.4 * over / max(close0 + sqrt(close0 * close0 + bend0 * over), 1e-6);
        t = min(t + max(max(far, far0), least), leave);
    }
    if (below.x < 0.0) return ahead ? above.x : -1.0;   // out of steps: nearly there
    return crossing(m0, m1, ro.y, rd.y, above, below);
}

// Mean of max(0, X) for X normal with mean m and deviation s: the area that a rough surface shows.
float shownArea(float m, float s) {
    float q = m / max(s, 1e-6);
    if (q > 4.0) return m;
    float density = 0.39894228 * exp(-0.5 * min(q * q, 80.0));
    float tail = 1.0 / (1.0 + 0.2316419 * abs(q));
    float above = 1.0 - density * tail * (0.31938153 + tail * (-0.356563782 + tail * (1.781477937
        + tail * (-1.821255978 + tail * 1.330274429))));   // Abramowitz and Stegun 26.2.17
    return max(m * (q < 0.0 ? 1.0 - above : above) + s * density, 1e-5);
}
// What a view along rd sees of slopes with a mean and a spread: the area shown, and the mean slope
// of what is shown, which leans towards the eye.
float shownSlope(vec3 rd, Sea s, out vec2 slope) {
    vec2 lean = vec2(s.spread.x * rd.x + s.spread.z * rd.z, s.spread.z * rd.x + s.spread.y * rd.z);
    float deviation = sqrt(max(dot(lean, rd.xz), 0.0)), m = dot(s.slope, rd.xz) - rd.y;
    float area = shownArea(m, deviation);
    float ahead = 1.0 / (1.0 + exp(clamp(-1.702 * m / max(deviation, 1e-6), -30.0, 30.0)));
    slope = s.slope + lean * (ahead / area);
    return area;
}
// The sun in a sea of nearly Gaussian slopes, for one unit of its light (Bruneton et al. 2010, eq.
// 7, with the shown area in closed form, and the first term of an Edgeworth series for the tails).
float seaGlitter(vec3 rd, Sea s, float area) {
    vec3 h = normalize(sunDirection() - rd + vec3(0.0, 1e-5, 0.0));
    if (h.y < 0.05) return 0.0;
    float sunSpread = square(0.25 * radians(sunSize));
    vec3 v = s.spread + vec3(sunSpread, sunSpread, 0.0);
    vec2 d = -h.xz / h.y - s.slope;
    float det = max(v.x * v.y - v.z * v.z, 1e-12);
    float q = (d.x * d.x * v.y + d.y * d.y * v.x - 2.0 * d.x * d.y * v.z) / det;
    float density = exp(-0.5 * min(q, 80.0)) / (2.0 * kPi * sqrt(det));
    float tails = s.tails * square((s.spread.x + s.spread.y) / (v.x + v.y));
    density *= max(1.0 + tails * (q * q - 8.0 * q + 8.0), 0.0);
    return fresnel(clamp(-dot(h, rd), 0.0, 1.0), kIorWater) * density
        / (4.0 * square(square(h.y)) * area);
}

// Refraction of the sun by nearly level water: the direction down, level offset a metre of depth
// (flat) and the matrix that a slope adds to it, for a first-order map of entry to floor.
vec3 sunUnderWater(vec3 sun, out mat2 byslope) {
    float eta = 1.0 / kIorWater, cosI = max(sun.y, 1e-3);
    float cosT = sqrt(1.0 - eta * eta * (1.0 - cosI * cosI)), m = eta * cosI - cosT;
    float bias = eta * (eta - eta * eta * cosI / cosT) / (cosT * cosT);
    byslope = mat2(bias * sun.x * sun.x - m / cosT, bias * sun.x * sun.z,
                   bias * sun.x * sun.z, bias * sun.z * sun.z - m / cosT);
    return vec3(-eta * sun.x, -cosT, -eta * sun.z);
}
// Slope by the eight longest waves; its derivatives xx, xz, zz by twelve. Those that are too short
// to gather light on the floor, where all the others blur them, are left out.
vec2 lensSlope(vec2 p) {
    vec2 slope = vec2(0.0);
    for (int g = 0; g < 2; ++g) {
        vec4 s = gLens[g] * sin(gKx[g] * p.x + gKz[g] * p.y + gPhase[g]);
        slope -= vec2(dot(s, gKx[g]), dot(s, gKz[g]));
    }
    return slope;
}
vec3 lensBend(vec2 p) {
    vec3 second = vec3(0.0);
    for (int g = 0; g < 3; ++g) {
        vec4 c = gLens[g] * cos(gKx[g] * p.x + gKz[g] * p.y + gPhase[g]);
        second -= vec3(dot(c * gKx[g], gKx[g]), dot(c * gKx[g], gKz[g]), dot(c * gKz[g], gKz[g]));
    }
    return second;
}
// Where light that reaches a point `down` metres deep came in, and how much the waves gather it. It
// lands at p = entry + down * aside(slope there); J, the derivative of that by the entry, says on
// how many square metres of sand one of water shines: 1/|J| is how bright it is.
float lightGathered(vec2 p, float down, vec3 light, mat2 byslope, out vec2 entry) {
    vec2 calm = light.xz / -light.y;
    entry = p - down * calm;
    if (caustics <= 0.0) return 1.0;
    for (int k = 0; k < 2; ++k) entry = p - down * (calm + byslope * lensSlope(entry));
    vec3 second = lensBend(entry);
    mat2 j = mat2(1.0) + down * byslope * mat2(second.xy, second.yz);
    float area = abs(j[0][0] * j[1][1] - j[0][1] * j[1][0]);
    // biased: one of several sheets of light where they fold, and none too sharp
    return mix(1.0, 1.0 / (area < 0.5 ? area * area + 0.25 : area), caustics);
}

// ---- The boat -----------------------------------------------------------------------------------
// Known by a distance that is never too long: then a ray that steps by it cannot pass through her
// (Hart). The hull at a station z is half an ellipse, from keel to sheer; deck, thwarts, spars and
// sail are boxes and sticks cut and joined by max and min. The least of them tells the part, too.

float sheerAt(float z) { return 0.40 + 0.31 * square((z + 0.35) / 2.5); }   // top of the side
float keelAt(float z) {
    return -0.27 + 0.64 * square(max(z - 1.0, 0.0) / 1.3) + 0.12 * square(max(-z - 0.7, 0.0) / 1.4);
}
float beamAt(float z) {   // half of it, at the sheer
    float fore = max(z + 0.25, 0.0) / 2.55, aft = max(-0.25 - z, 0.0) / 1.85;
    return max(0.80 * (1.0 - fore * fore) * (1.0 - 0.36 * aft * aft), 0.012);
}
// A station is half an ellipse. Its gradient, from the sides' 0.9 along z and the estimate across,
// stays below 1 / 0.62. x: distance to the sides, at most; y: height over the sheer.
vec2 hullSides(vec3 p) {
    float z = clamp(p.z, kStern - 0.1, kBow + 0.1), sheer = sheerAt(z);
    vec2 r = vec2(beamAt(z), sheer - keelAt(z)), d = vec2(abs(p.x), min(p.y - sheer, 0.0));
    float k0 = length(d / r), k1 = length(d / (r * r));
    float reach = k0 > 1.0 ? k0 / k1 : min(r.x, r.y);
    return vec2(0.62 * (k0 - 1.0) * reach, 0.96 * (p.y - sheer));
}
float hullEnds(vec3 p) { return max(kStern - 0.10 * p.y - p.z, p.z - kBow); }
// Negative in the boat and in the air that she holds.
float hullBody(vec3 p) {
    vec2 side = hullSides(p);
    return max(side.x, max(side.y, hullEnds(p)));
}
float stick(vec3 p, vec3 a, vec3 b, float r) {
    vec3 u = p - a, v = b - a;
    return length(u - clamp(dot(u, v) / dot(v, v), 0.0, 1.0) * v) - r;
}
void keepNearest(float d, int its, inout float best, inout int part) {
    if (d < best) {
        best = d;
        part = its;
    }
}
// Planks and deck, hollowed by the well; rail, thwarts and keel.
float hullField(vec3 p, out int part) {
    vec2 side = hullSides(p);
    float ends = hullEnds(p), solid = max(side.x, max(side.y, ends));
    float well = max(max(side.x + 0.02, kBottom - p.y), max(kAfterDeck - p.z, p.z - kDeckEnd));
    float best = max(solid, -well);
    part = -well > solid ? kWell : side.y > max(side.x, ends) ? kDeck : kPlanks;

    float rail = max(length(vec2(side.x, side.y + 0.012)) - 0.024, 0.96 * (ends - 0.03));
    keepNearest(rail, kRail, best, part);
    float thwart = min(abs(p.z - kMastAt) - 0.13, abs(p.z + 0.70) - 0.14);
    thwart = max(max(thwart, abs(p.y - 0.19) - 0.016), side.x + 0.012);
    keepNearest(thwart, kThwart, best, part);
    float under = keelAt(clamp(p.z, kStern, kBow));   // keel and stem
    float keel = max(max(abs(p.x) - 0.022, ends - 0.03),
                     max(0.7 * (under - 0.05 - p.y), side.y - 0.03));
    keel = max(keel, min(0.7 * (p.y - under - 0.06), 2.2 - p.z));
    keepNearest(keel, kRail, best, part);
    return best;
}
// Mast, boom, oars, tiller, and the rudder's blade. m: from the mast's foot; q: in the sail's
// frame.
void gearField(vec3 p, vec3 m, vec3 q, inout float best, inout int part) {
    float spar = max(0.99 * (length(m.xz) - 0.046 + 0.006 * p.y), max(p.y - kMastTop, -0.1 - p.y));
    if (sail) spar = min(spar, stick(q, vec3(0.0, 1.30, 0.04), vec3(-0.03, 0.96, 2.06), 0.020));
    // Oars, and the tiller.
    vec3 o = vec3(abs(p.x) - 0.40, p.y, p.z);
    spar = min(spar, stick(o, vec3(0.0, 0.235, -1.45), vec3(-0.06, 0.235, 0.95), 0.021));
    vec3 h = vec3(turn(p.xz - vec2(0.0, kStern - 0.09), gRudder), p.y).xzy;
    spar = min(spar, stick(h, vec3(0.0, 0.62, -0.05), vec3(0.0, 0.70, 0.85), 0.018));
    keepNearest(spar, kSpar, best, part);
    vec3 blade = abs(h - vec3(0.0, 0.14, -0.15)) - vec3(0.016, 0.50, 0.15 - 0.1 * min(h.y, 0.4));
    float rudder = 0.97 * max(blade.x, max(blade.y, blade.z));
    keepNearest(rudder, kRudder, best, part);
}
// A triangle that bellies to lee. q: x to lee, y up, z along the boom.
float clothField(vec3 q) {
    float reach = kChord * clamp((kHead - q.y) / (kHead - kTack), 0.0, 1.0);
    float along = clamp(q.z, 0.0, reach);
    float belly = 0.26 * clamp(2.5 * gBoom, -1.0, 1.0) * along
        * (1.0 - along / max(reach, 1e-3));
    float leech = dot(q.zy - vec2(kChord, kTack), vec2(0.8381, 0.5455));
    float foot = 0.99 * (kTack - 0.10 * q.z * (kChord - q.z) - q.y);
    return max(0.9 * abs(q.x - belly) - 0.007, max(leech, max(0.8 * foot, 0.05 - q.z)));
}
// Never more than the distance; part: what is nearest.
float boatField(vec3 p, out int part) {
    float best = hullField(p, part), c = cos(gBoom), s = sin(gBoom);
    vec3 m = p - vec3(0.0, 0.0, kMastAt);
    vec3 q = vec3(c * m.x + s * m.z, p.y, s * m.x - c * m.z);   // the sail's frame
    gearField(p, m, q, best, part);
    if (sail) keepNearest(clothField(q), kCloth, best, part);
    return best;
}
vec3 toBoat(vec3 p) { return (p - vec3(0.0, gHeave, 0.0)) * gAxes; }
// Where a ray in the boat's frame may meet her; nothing when y < x.
vec2 boatSpan(vec3 ro, vec3 rd, float grow) {
    vec3 lo = vec3(-0.9, -0.5, -2.6), hi = vec3(0.9, kMastTop, 2.36);
    if (sail) {
        lo.x = -1.75;
        hi.x = 1.75;
    }
    vec3 inv = safeInverse(rd), a = (lo - grow - ro) * inv, b = (hi + grow - ro) * inv;
    vec3 n = min(a, b), f = max(a, b);
    return vec2(max(maxComponent(n), 0.0), min(f.x, min(f.y, f.z)));
}
// The boat on a ray before tMax, without a normal. Nothing is found for tMax 0.
Hit hitBoat(vec3 ro, vec3 rd, float pixel, float tMax) {
    vec3 o = toBoat(ro), d = rd * gAxes;
    vec2 span = boatSpan(o, d, 0.0);
    span.y = min(span.y, tMax);
    float t = span.x, f = 1.0;
    int part = kNone;
    bool ahead = span.x < span.y;
    for (int k = 0; k < boatSteps && ahead; ++k) {
        f = boatField(o + t * d, part);
        bool met = f < 4e-4 + 0.15 * pixel * t;
        if (!met) t += f;
        ahead = !met && t < span.y;
    }
    Hit h = Hit(t, part, vec3(0.0, 1.0, 0.0), o + t * d, 0.0);
    if (!(t < span.y) || f > 0.02) {   // or out of steps far from her
        h.part = kNone;
        h.t = kFar;
    }
    return h;
}
// The normals of what two rays met, from the field at the corners of a tetrahedron, and the room
// before what the first met, from two looks along its normal: all in one loop, for a driver
// compiles a copy of the field for each place that calls it.
void feelBoat(float pixel, inout Hit shown, inout Hit below) {
    vec3 g = vec3(0.0);
    int last = below.part == kNone ? 6 : 10;
    for (int k = shown.part == kNone ? 6 : 0; k < last; ++k) {
        bool first = k < 6, looks = k == 4 || k == 5;
        int corner = first ? k : k - 6, other;
        vec3 e = vec3((corner + 3 >> 1) & 1, corner >> 1, corner & 1) * 2.0 - 1.0;
        float w = 0.0015 + 0.2 * pixel * min(first ? shown.t : below.t, 100.0);
        float far = k == 4 ? 0.10 : 0.35;
        vec3 aside = looks ? (shown.nor * far) * gAxes : w * e;
        float f = boatField((first ? shown.q : below.q) + aside, other);
        if (looks) shown.room += f / far;
        else g += e * f;
        vec3 nor = gAxes * (g * inversesqrt(max(dot(g, g), 1e-20)));
        if (k == 3) {
            shown.nor = nor;
            g = vec3(0.0);
        }
        if (k == 9) below.nor = nor;
    }
}
// Share of the sun that a point sees past the boat; rim: slope of the sun's disc. The narrowest
// gap between the ray and her, against the cone's width there, tells how much of it is hidden.
float pastBoat(vec3 ro, vec3 rd, float rim, float tMax) {
    vec3 o = toBoat(ro), d = rd * gAxes;
    vec2 span = boatSpan(o, d, 0.1);
    span.y = min(span.y, tMax);
    float t = max(span.x, 0.012), gap = 1.0;
    bool ahead = t < span.y;
    for (int k = 0; k < 40 && ahead; ++k) {
        int part;
        float f = boatField(o + t * d, part);
        gap = min(gap, f / (rim * t + 1e-3));
        t += max(f, 0.006 + 0.2 * rim * t);
        ahead = t < span.y && gap > -1.0;
    }
    gap = max(gap, -1.0);
    return 0.25 * square(1.0 + gap) * (2.0 - gap);
}
float boatShade(vec3 p, vec3 rd, float blur, float tMax, float seed) {
    float rim = tan(radians(sunSize)) + blur;
    if (shadows == 0) return 1.0;
    if (shadows == 1) return pastBoat(p, rd, rim, tMax);
    vec3 u = normalize(cross(rd, vec3(0.0, 0.0, 1.0) + 0.01 * rd.zxy)), v = cross(u, rd);
    float sum = 0.0;
    for (int k = 0; k < sunSamples; ++k) {
        float a = 2.0 * kPi * (kGolden * float(k) + seed);
        float r = rim * sqrt((float(k) + 0.5) / float(sunSamples));
        sum += pastBoat(p, normalize(rd + r * (u * cos(a) + v * sin(a))), 2e-4, tMax);
    }
    return sum / float(sunSamples);
}

// Wood's grain, -1 to 1, drawn out along z; w: footprint.
float grain(vec3 p, float w) {
    vec2 uv = vec2(p.x + 0.83 * p.y, 0.12 * p.z + 0.2 * p.y) * 1.6;
    return textureLod(motif, uv, log2(max(w * 1.6 * 512.0, 1e-3))).a * 2.0 - 1.0;
}
// Colour, and in w how far it is varnished; planks tilt the normal. w: footprint.
vec4 paintOf(int part, vec3 q, float w, inout vec3 nor) {
    vec3 mahogany = vec3(0.19, 0.058, 0.020), oak = vec3(0.36, 0.185, 0.070);
    float z = clamp(q.z, kStern, kBow), sheer = sheerAt(z);
    // Round a station from the sheer, 0, to the keel, 1; strakes are 1/7 of it.
    float girth = atan(max(sheer - q.y, 0.0) / (sheer - keelAt(z)), abs(q.x) / beamAt(z) + 1e-4)
        * (2.0 / kPi);
    float strake = 7.0 * girth, wide = w * 7.0 / 1.15, distinct = clamp(1.3 - 2.0 * wide, 0.0, 1.0);
    float seam = lines(strake, 0.035, wide), shape = fract(strake) - 0.5;
    float pale = part == kThwart || part == kWell ? 0.75 : part == kSpar ? 1.1 : 0.0;
    vec3 wood = mix(mahogany, oak, pale);
    bool across = part == kWell && (q.z > kDeckEnd - 0.01 || q.z < kAfterDeck + 0.01);
    float off = distance(q.xz, vec2(0.0, kMastAt));
    bool upright = across || part == kRudder || part == kSpar && off < 0.06;
    vec3 lie = upright ? q.xzy : part == kThwart ? q.zyx : q;
    if (part == kSpar && off >= 0.06 && q.y > 0.85) lie = vec3(q.y, 0.0, off);
    float figure = part == kCloth ? 0.0 : grain(lie, w);
    wood *= 1.0 + 0.55 * figure;
    if (part == kPlanks || part == kWell) {
        vec3 down = gAxes * vec3(0.0, -1.0, 0.0);
        nor = normalize(nor + (part == kPlanks ? 0.20 : -0.10) * distinct * shape * down);
    }
    if (part == kPlanks) {
        float line = smoothstep(-0.5 * w - 0.002, 0.5 * w + 0.002, q.y - 0.045);
        float boot = smoothstep(-0.5 * w - 0.002, 0.5 * w + 0.002, q.y - 0.095);
        float top = 1.0 - smoothstep(1.0 - 0.5 * wide, 1.0 + 0.5 * wide, strake);
        vec3 side = mix(vec3(0.16, 0.022, 0.018), vec3(0.012, 0.045, 0.085), line);
        side = mix(side, linearColour(hullColour) * (1.0 + 0.05 * figure), boot);
        side = mix(side, wood, top);
        return vec4(side * (1.0 - 0.45 * seam), 0.6 + 0.4 * top);
    }
    if (part == kWell) {   // planks, ribs, the boards of the bottom
        bool level = q.y < kBottom + 0.01 || across;
        float board = level ? lines(q.x / 0.11 + 0.5, 0.04, w / 0.11) : seam;
        float rib = level ? 0.0 : lines(q.z / 0.34, 0.055, w / 0.34);
        return vec4(wood * (1.0 - 0.5 * board) * (1.0 - 0.3 * rib), 0.35);
    }
    if (part == kDeck) {
        float caulk = lines(q.x / 0.075 + 0.5, 0.045, w / 0.075);
        float edge = smoothstep(0.0, 0.02 + w, -hullSides(q).x - 0.025);
        wood = mix(mahogany, oak * (1.0 + 0.4 * figure), edge);
        return vec4(wood * (1.0 - 0.8 * caulk * edge), 0.8);
    }
    if (part == kCloth) {
        float panel = lines(q.y / 0.42 + 0.08 * q.z, 0.018, w / 0.42);
        return vec4(linearColour(sailColour) * (1.0 - 0.25 * panel), 0.0);
    }
    return vec4(wood, part == kThwart ? 0.6 : 1.0);
}

// ---- Light --------------------------------------------------------------------------------------
// What each thing sends to the eye: sky and deep water by looking up a blurred picture of the sky,
// sand and wood as matt surfaces, varnish and foam above them.

// The sky's picture goes from the horizon to straight up, where its last row lies, finest low; a:
// how clear the view of the sun is. cone: rad, what is seen as one.
vec4 heavens(vec3 rd, float cone) {
    float lod = clamp(log2(max(cone, 1e-4) * 2048.0 / (2.0 * kPi)), 0.0, 7.0);
    float edge = min(exp2(ceil(lod)) / 1024.0, 0.5);
    float v = sqrt(max(rd.y, 0.0)) * (1.0 - 1.0 / 1024.0);
    return textureLod(sky, vec2(atan(rd.x, -rd.z + 1e-9) / (2.0 * kPi) + 0.5,
                                clamp(v, edge, 1.0 - edge)), lod);
}
// What waves from both sides of a wide cone mirror: the sky, or more water.
vec3 mirroredSky(vec3 rd, float cone) {
    return heavens(normalize(vec3(rd.x, max(rd.y, 0.02), rd.z)), cone).rgb;
}
vec3 bodyLight(float share) {   // scattered back by deep water
    vec3 down = gAmbient + sunLight() * (sunDirection().y * share);
    return linearColour(deepColour) * down;
}
// The sand: colour, and the slope of its ripples. Weed grows in patches.
vec4 seabed(vec2 p, float w) {
    vec2 unit = (p + gPlace) / kWorld;
    float far = textureLod(motif, 10.0 * unit + vec2(0.55, 0.21), log2(max(w * 10.67, 1e-3))).r;
    vec4 near = textureLod(motif, 96.0 * unit, log2(max(w * 102.4, 1e-3)));
    float weed = smoothstep(0.64, 0.74, far + 0.45 * (near.r - 0.5)), slope = 2.0 * near.b - 1.0;
    vec3 sand = vec3(0.68, 0.57, 0.40) * (0.80 + 0.40 * near.r - 0.08 * slope);
    vec3 grass = vec3(0.040, 0.062, 0.026) * (0.3 + 1.4 * near.r + 0.6 * near.g);
    return vec4(mix(sand, grass, weed), 0.30 * (1.0 - weed) * slope);
}
// Light from a point of the boat against d. share: of the sun that it sees; w: footprint.
vec3 boatLight(Hit h, vec3 p, vec3 d, float share, float w) {
    vec3 nor = h.nor, sun = sunDirection();
    vec4 stuff = paintOf(h.part, h.q, w, nor);
    if (dot(nor, d) > 0.0) nor = normalize(nor - 1.02 * dot(nor, d) * d);
    float open = 0.25 + 0.75 * smoothstep(0.0, 1.5, h.room);
    vec3 up = mirroredSky(vec3(nor.x, max(nor.y, 0.0) + 0.35, nor.z), 1.2);
    vec3 below = bodyLight(1.0) + 0.10 * gAmbient;
    bool outside = h.part == kPlanks || h.part == kRudder || h.part == kRail;
    if (!outside) below = 0.3 * below + vec3(0.16, 0.10, 0.055) * (gAmbient + 0.2 * sunLight());
    vec3 around = mix(below, 0.5 * (up + gAmbient), 0.5 + 0.5 * nor.y) * open;
    float lit = dot(nor, sun);
    vec3 light = stuff.rgb * (around + sunLight() * (share * max(lit, 0.0)));
    if (h.part == kCloth)   // it glows against the light
        light += stuff.rgb * stuff.rgb * (sunLight() * max(-lit, 0.0) * 0.28 + 0.25 * gAmbient);
    float facing = clamp(-dot(nor, d), 0.0, 1.0), gloss = stuff.w * fresnel(facing, 1.45);
    vec3 away = reflect(d, nor);
    vec3 seen = mix(below, mirroredSky(away, 0.12), smoothstep(-0.12, 0.06, away.y)) * open;
    float line = exp2(180.0 * (dot(away, sun) - 1.0)) * 30.0;
    return light + gloss * (seen + sunLight() * (share * line * step(0.0, lit)));
}
// Share of a pixel that foam covers, for an amount of it: lace, which a gale draws out. The noise is
// stretched along the wind by matrices of whole numbers, so that it still fits the world's square.
float foamCover(vec2 p, float amount, float w) {
    vec2 unit = (p + gPlace) / kWorld;
    float a = radians(windAngle), lod = log2(max(w * 102.4, 1e-3));
    float drawn = smoothstep(0.3, 0.8, steepness);
    vec2 along = vec2(sin(a), -cos(a)), across = vec2(along.y, -along.x);
    vec2 wide1 = floor(104.0 * across + 0.5), long1 = floor(mix(96.0, 30.0, drawn) * along + 0.5);
    vec2 wide2 = floor(43.0 * across + 0.5), long2 = floor(mix(38.0, 7.0, gale()) * along + 0.5);
    float fine = textureLod(motif, vec2(dot(wide1, unit), dot(long1, unit)), lod).g;
    float large = textureLod(motif, vec2(dot(wide2, unit), dot(long2, unit)), lod - 1.3).g;
    float lace = 0.65 * fine + 0.6 * large - 0.12, soft = 0.14 + 0.05 * clamp(lod, 0.0, 6.0);
    float torn = smoothstep(1.0 - amount - soft, 1.0 - amount + soft, lace);
    float cover = min(1.2 * amount, 1.0) * torn * (0.35 + 0.65 * min(lace, 1.0));
    if (gale() <= 0.0) return cover;
    // A gale thins the patches out, and draws what is old in long rows down the wind.
    float rows = large * (0.45 + 0.9 * fine);
    cover *= mix(1.0, 0.4 + 0.9 * fine, gale());
    return mix(cover, 1.0, 0.5 * gale() * smoothstep(0.55 - soft, 0.95 + soft, rows));
}
// Streaks of rain on three shells round the eye; w: angle of a pixel.
float rainStreaks(vec3 rd, float w) {
    float sum = 0.0, around = atan(rd.x, -rd.z + 1e-9) / (2.0 * kPi) + 0.5;
    float level = max(length(rd.xz), 0.15);
    for (int k = 0; k < 3; ++k) {
        float far = 1.6 * exp2(float(k)), n = 260.0 * exp2(float(k));
        float x = fract(around + 0.02 * rd.y / level) * n, c = min(floor(x), n - 1.0);
        vec3 r = random3(ivec3(int(c), k, 71));
        float y = rd.y / level * far / 2.4 + 0.15 * (x - c) + r.x
            + 16.0 * cycles((3.0 + floor(3.0 * r.y)) / 16.0);   // there are 16 of each
        vec3 s = random3(ivec3(int(c), int(floor(y)) & 15, 72 + k));
        float wide = 0.0022 / far, half1 = 0.5 * max(wide, w) * n / (2.0 * kPi);
        float off = abs(x - c - 0.3 - 0.4 * s.x);
        float line = clamp((half1 - off) / (w * n / (2.0 * kPi)) + 0.5, 0.0, 1.0);
        line *= min(wide / w, 1.0);
        float along = fract(y) / 0.30;
        sum += line * smoothstep(0.0, 0.3, along) * (1.0 - smoothstep(0.7, 1.0, along))
            * step(s.y, 0.75 * rain);
    }
    return min(sum, 1.0);
}

bool meetsBoat(vec3 ro, vec3 rd, float tMax) {   // perhaps: her box
    vec2 span = boatSpan(toBoat(ro), rd * gAxes, 0.15);
    return span.x < min(span.y, tMax);
}

// ---- Transport ----------------------------------------------------------------------------------
// Light on a pixel of sea comes on two ways: mirrored, from sky or boat, and refracted, from the
// sand or the hull under water, dimmed by exp(-sigma path) (Beer). Fresnel shares it out between
// them. The sun meets the boat on up to four of their legs. What could not be met anyway is
// skipped, and all rays of a kind go through one loop: a driver writes a function out wherever it
// is called, so a march that is called in three places is compiled, and carried along, three times.

vec3 viewRay(Eye e, vec2 pixel) {
    vec2 uv = (pixel - 0.5 * iResolution.xy) / iResolution.y;
    return normalize(uv.x * e.right + uv.y * e.up + e.lens * e.forward);
}
// A point of the sea that the eye meets, and both ways on from there.
struct Water {
    vec3 p;                // m
    Sea sea;
    vec2 white;            // crests in line, foam of the wake
    float area;            // shown by the rough surface, of a level metre
    vec3 facet;            // mean normal of what is shown
    vec3 away, down;       // mirrored and refracted, unit
    float mirrored;        // Fresnel's share
    float t;               // from the eye
    float deep;            // m along `down` to the sand
};
// Where the sun's light on the ground came in, for a point of sand or hull under water.
struct Sunken {
    vec3 ground, from;     // the point, and its place of entry
    vec3 back;             // the way there, unit
    vec3 ray;              // the sun's way down in level water
    float gather;          // how much the waves gather it
    float down, path;      // m: its depth, and its distance from `from`
};

Water waterAt(Eye e, vec3 rd, float angle, float t, bool wet) {
    Water s;
    s.t = t;
    s.p = e.pos + t * rd;
    vec2 slope;
    s.sea = seaAt(s.p.xz, seaFootprint(rd, angle * t), s.white);
    s.area = shownSlope(rd, s.sea, slope);
    s.facet = normalize(vec3(-slope, 1.0).xzy);
    s.away = reflect(rd, s.facet);   // biased: no light between waves
    s.away = normalize(vec3(s.away.x, max(s.away.y, 0.02), s.away.z));
    float cosine = clamp(-dot(s.facet, rd), 0.0, 1.0);
    s.mirrored = fresnel(cosine, kIorWater);
    float eta = 1.0 / kIorWater, k2 = (1.0 - eta) * (1.0 + eta) + square(eta * cosine);
    s.down = normalize(eta * rd + (eta * cosine - sqrt(k2)) * s.facet);
    s.down.y = min(s.down.y, -0.05);
    s.deep = wet ? (depth + s.p.y) / -s.down.y : 1.0;
    return s;
}

// The boat as the water shows her: mirrored, and below its surface. Rays that miss her box are
// skipped. The bits of `todo` are the rays that are left, and a turn of the loop takes one.
void boatFromWater(Water s, float angle, inout Hit mirrored, inout Hit below) {
    float reach = min(s.deep, 8.0);
    int todo = (reflection && meetsBoat(s.p, s.away, 30.0) ? 1 : 0)
        + (meetsBoat(s.p, s.down, reach) ? 2 : 0);
    for (int turns = 0; turns < 2 && todo != 0; ++turns) {
        bool up = (todo & 1) != 0;
        Hit x = hitBoat(s.p + vec3(0.0, up ? 0.004 : -0.002, 0.0), up ? s.away : s.down, angle,
                        up ? 30.0 : reach);
        if (up) mirrored = x;
        else below = x;
        todo &= todo - 1;
    }
}

// path: m from the surface along s.down; low: towards the sun, never below the horizon.
Sunken sunkenAt(Water s, float path, float angle, vec3 low, bool wet) {
    Sunken g;
    mat2 byslope;
    vec2 entry;
    g.ground = s.p + path * s.down;
    g.ray = sunUnderWater(low, byslope);
    g.down = max(-g.ground.y, 0.0);
    g.gather = lightGathered(g.ground.xz, g.down, g.ray, byslope, entry);
    float blurred = 4.0 * angle * (s.t + path) / max(-s.down.y, 0.1);   // a pixel, m on the sand
    g.gather = mix(g.gather, 1.0, 1.0 - exp(-min(blurred * blurred * 8.0, 40.0)));
    g.from = vec3(entry, wet ? moversAt(entry) : 0.0).xzy;
    g.back = normalize(g.from - g.ground + vec3(0.0, 1e-4, 0.0));
    g.path = distance(g.from, g.ground);
    return g;
}

// Shares of the sun past the boat: x on the water, y on her (at q, if she is shown), z and w on
// both legs of the way to the ground: above the water and below it.
vec4 sunShares(Water s, Sunken g, vec3 q, vec3 nor, vec3 low, bvec2 wetShown, float chance) {
    vec4 share = vec4(1.0);
    bool wet = wetShown.x;
    int todo = shadows == 0 || overcast >= 1.0 ? 0
        : (wet && meetsBoat(s.p, sunDirection(), kFar) ? 1 : 0) + (wetShown.y ? 2 : 0)
        + (wet && meetsBoat(g.from, low, kFar) ? 4 : 0)
        + (wet && meetsBoat(g.ground, g.back, g.path) ? 8 : 0);
    for (int turns = 0; turns < 4 && todo != 0; ++turns) {
        int bit = todo & -todo;
        vec3 o = bit == 1 ? s.p : bit == 2 ? q + 0.006 * nor : g.from;
        if (bit == 8) o = g.ground + 0.01 * g.back;
        float blur = bit == 1 ? 0.004 : bit == 2 ? 0.0 : bit == 4 ? 0.010 : 0.05;
        float seen = boatShade(o, bit == 8 ? g.back : low, blur, bit == 8 ? g.path : kFar, chance);
        share = mix(share, vec4(seen), equal(ivec4(bit), ivec4(1, 2, 4, 8)));
        todo &= todo - 1;
    }
    return share;
}

// Light out of the water: sand or hull in sun and sky, and what the water itself scatters.
vec3 throughWater(Water s, Sunken g, Hit below, float path, float angle, vec4 share, vec3 low) {
    bool hull = below.part != kNone;
    vec4 stuff = seabed(g.ground.xz, angle * (s.t + path) / -s.down.y);
    vec3 nor = hull ? below.nor : normalize(vec3(stuff.w * 0.88, 1.0, stuff.w * 0.47));
    vec3 albedo = hull ? vec3(0.16, 0.022, 0.018) : stuff.rgb, sigma = absorption();
    float facing = max(dot(nor, g.ray) / g.ray.y, 0.0) * low.y * (1.0 - fresnel(low.y, kIorWater));
    vec3 lit = 0.9 * gAmbient * exp(-1.2 * sigma * g.down) * (0.6 + 0.4 * nor.y)
        + sunLight() * (share.z * share.w * facing * g.gather) * exp(-sigma * g.path);
    vec3 left = exp(-sigma * path);   // crests are thin, light comes through them
    float lift = s.white.x > 0.0 ? 2.5 : 0.7;   // and troughs are deep and shaded
    vec3 body = bodyLight(mix(0.25, 1.0, share.x)) * max(1.0 + lift * s.white.x, 0.45);
    vec3 through = albedo * lit * left + body * (1.0 - exp(-0.6 * (sigma + 0.08) * path));
    return mix(body, through, hull ? 1.0 : floorShare);
}
// In a trough between steep waves what a low ray would mirror is the next wave's face, not the sky.
float inTrough(Water s) {
    float top = 0.6 * dot(gHeight[0], vec4(1.0));
    return 0.7 * gale() * clamp(0.5 - 0.5 * s.p.y / max(top, 1e-3), 0.0, 1.0)
        * (1.0 - smoothstep(0.1, 0.8, s.away.y));
}
// Foam where crests of several waves come together, and in the wake. seen: of the sun.
vec3 underFoam(Water s, vec3 light, float angle, float seen) {
    float breaking = smoothstep(0.20, 0.52, s.white.x + 0.16 * (foam - 0.5));
    float amount = foam * breaking + s.white.y;
    float cover = foamCover(s.p.xz, min(amount, 1.0), angle * s.t);
    float facing = max(dot(s.facet, sunDirection()), 0.0);
    vec3 snow = mix(0.75, 0.9, gale()) * (gAmbient + sunLight() * (facing * seen));
    return mix(light, snow, cover);
}
// Spray before what a ray meets at `reach`, torn into wisps that fly with the wind.
vec3 throughSpray(vec3 light, Eye e, vec3 rd, float angle, float reach) {
    float t = gSpray.y, a = radians(windAngle);
    if (gSpray.x < 0.004 || t > reach) return light;
    vec3 p = e.pos + t * rd;
    vec2 unit = (p.xz + gPlace) / kWorld, along = vec2(sin(a), -cos(a));
    vec2 across = vec2(along.y, -along.x);
    vec2 at = vec2(dot(floor(30.0 * across + 0.5), unit) + 0.25 * p.y,
                   dot(floor(9.0 * along + 0.5), unit) - cycles(0.2));
    float wisps = textureLod(motif, at, log2((0.1 + angle * t) * 32.0)).g;
    float cover = 0.9 * gale() * gSpray.x * smoothstep(0.1, 0.6, wisps);
    cover *= exp(-min(square(t / 60.0), 20.0));   // far off they are haze
    cover *= 1.0 - smoothstep(0.2, 0.5, -rd.y);   // a layer that steep rays cross between steps
    return mix(light, 0.95 * (gAmbient + 0.3 * sunLight()), cover);
}
// The sun's disc and the glow round it; clear: how clear the sky before it is.
vec3 sunSeen(vec3 rd, float angle, float clear) {
    vec3 sun = sunDirection();
    float away2 = dot(rd - sun, rd - sun), r2 = square(radians(sunSize));
    float edge = max(angle, 1e-4) * 0.5 * sqrt(r2);
    float disc = clear * (1.0 - smoothstep(r2 - edge, r2 + edge, away2));
    return sunBleached() * (disc * 600.0 + clear * (0.0016 / (away2 + 0.0006) + 0.02));
}
// Haze before a thing `reach` m away, then rain before all; open: nothing but sky is there.
vec3 throughAir(vec3 light, vec3 rd, float angle, float reach, bool open) {
    vec3 level = normalize(vec3(rd.x, 1e-3, rd.z) + vec3(0.0, 0.02, 0.0));
    if (!open) light = mix(heavens(level, 0.05).rgb, light, exp(-min(reach / visibility, 60.0)));
    if (rain > 0.0) {
        float veil = open ? 1.0 - exp(-min(900.0 / visibility, 60.0)) : 0.0;
        light = mix(light, heavens(level, 0.3).rgb, veil * (1.0 - smoothstep(0.0, 0.5, rd.y)));
        light += 0.16 * gAmbient * rainStreaks(rd, angle);
    }
    return light;
}

// Light that arrives at the eye against rd. angle: of a pixel, rad; chance: turns the shadow's
// rays.
vec3 render(Eye e, vec3 rd, float angle, float chance) {
    float t = hitWaves(e.pos, rd, angle, kFar);
    if (t > 0.0 && hullBody(toBoat(e.pos + t * rd)) < 0.0) t = -1.0;   // she keeps the sea out
    Hit h = hitBoat(e.pos, rd, angle, t > 0.0 ? t : kFar);
    bool wet = h.part == kNone && t > 0.0;
    t = wet ? min(t, 1e5) : 1.0;
    Water s = waterAt(e, rd, angle, t, wet);
    vec3 distant = wet ? s.away : rd;
    vec4 far = heavens(distant, wet ? 1.2 * sqrt(s.sea.spread.x + s.sea.spread.y) + angle : angle);
    vec3 light = far.rgb;

    Hit m = h, below = h;   // the boat, seen or mirrored, and under water
    below.part = kNone;
    if (wet) boatFromWater(s, angle, m, below);
    bool shown = m.part != kNone;
    feelBoat(angle, m, below);
    vec3 q = (wet ? s.p : e.pos) + min(m.t, 1e3) * distant;
    vec3 low = sunDirection();
    low.y = max(low.y, 0.01);
    float path = below.part != kNone ? below.t : s.deep;
    Sunken g = sunkenAt(s, path, angle, low, wet);
    vec4 share = sunShares(s, g, q, m.nor, low, bvec2(wet, shown), chance);

    float before = wet ? t : 0.0;
    if (wet && gale() > 0.0) light = mix(light, 0.5 * bodyLight(share.x), inTrough(s));
    if (shown) light = boatLight(m, q, distant, share.y, angle * (before + min(m.t, 1e3)));
    if (wet) {
        vec3 through = throughWater(s, g, below, path, angle, share, low);
        light = s.mirrored * light + (1.0 - s.mirrored) * through;
        light += sunBleached() * (kPi * share.x * seaGlitter(rd, s.sea, s.area));
        if (foam > 0.0) light = underFoam(s, light, angle, share.x);
    } else if (!shown) {
        light += sunSeen(rd, angle, far.a);
    }
    float reach = wet ? t : shown ? m.t : kFar;
    if (gale() > 0.0) light = throughSpray(light, e, rd, angle, reach);
    return throughAir(light, rd, angle, reach, !wet && !shown);
}

// ---- Passes -------------------------------------------------------------------------------------
// What no pixel need work out for itself: the sky once per look, the boat's state and her wake 240
// times a second, whatever the frame rate, and what all pixels share of a frame: waves and axes.

// Single scattering in clear and hazy air, by the angle to the sun's bearing and the height.
void mainAir(out vec4 colour, in vec2 pixel) {
    vec2 uv = pixel / iResolution.xy;
    vec3 sun = sunDirection(), sunward = vec3(0.0, sun.y, -sqrt(max(1.0 - sun.y * sun.y, 0.0)));
    float v = min(uv.y / (1.0 - 0.5 / iResolution.y), 1.0), up = v * v;
    float level = sqrt(1.0 - up * up), a = kPi * uv.x;
    vec3 rd = vec3(level * sin(a), up, -level * cos(a)), ro = vec3(0.0, 6360.3, 0.0);   // km
    vec3 rayleigh = vec3(5.8e-3, 13.5e-3, 33.1e-3), ozone = vec3(0.65e-3, 1.88e-3, 0.085e-3);
    float mie = 3.0e-3 * haze, mu = dot(rd, sunward), g = 0.76;
    float end = -ro.y * rd.y + sqrt(square(ro.y * rd.y) + square(6440.0) - ro.y * ro.y);
    vec3 sum = vec3(0.0), seen = vec3(0.0);
    for (int i = 0; i < 32; ++i) {
        float t0 = end * square(float(i) / 32.0), t1 = end * square(float(i + 1) / 32.0);
        vec3 p = ro + 0.5 * (t0 + t1) * rd;
        float r = length(p), h = r - 6360.0, toSun = dot(p, sunward);
        vec2 dense = exp(-h / vec2(8.0, 1.2));
        vec3 loss = rayleigh * dense.x + 1.1 * mie * dense.y
            + ozone * max(1.0 - abs(h - 25.0) / 15.0, 0.0);
        seen += 0.5 * (t1 - t0) * loss;
        float leave = -toSun + sqrt(toSun * toSun + square(6440.0) - r * r);
        vec3 shade = vec3(0.0);
        for (int j = 0; j < 8; ++j) {
            vec3 q = p + sunward * leave * (float(j) + 0.5) / 8.0;
            float hq = max(length(q) - 6360.0, 0.0);
            shade += rayleigh * exp(-hq / 8.0) + 1.1 * mie * exp(-hq / 1.2)
                + ozone * max(1.0 - abs(hq - 25.0) / 15.0, 0.0);
        }
        float hg = (1.0 - g * g) / (4.0 * kPi * pow(max(1.0 + g * g - 2.0 * g * mu, 1e-3), 1.5));
        vec3 phase = rayleigh * dense.x * (3.0 / (16.0 * kPi) * (1.0 + mu * mu));
        // biased: an even share stands for light scattered more than once
        phase += mie * dense.y * hg + (rayleigh * dense.x + mie * dense.y) * 0.025;
        sum += (t1 - t0) * phase * exp(-seen - shade * leave / 8.0);
        seen += 0.5 * (t1 - t0) * loss;
    }
    colour = vec4(31.4 * sum, 1.0);   // the sun's 10 x pi
}

float ridge(float turns, int seed) {   // smooth noise round the horizon
    float x = turns * 48.0, i = floor(x), f = x - i, s = f * f * (3.0 - 2.0 * f);
    ivec2 c = (ivec2(int(i)) + ivec2(0, 1) + 96) % 48;
    return mix(random3(ivec3(c.x, seed, 3)).x, random3(ivec3(c.y, seed, 3)).x, s);
}

// Clouds on a flat layer, 0 to 1, whose octaves curl.
float cloudNoise(vec3 rd, float up) {
    // Wider round the zenith, where all columns of the picture meet in a point.
    float wide = 1.0 - exp(-40.0 * (1.0 - up * up)), sum = 0.0, weight = 0.5;
    vec2 q = turn(rd.xz * wide / (up + 0.05), 0.5) * vec2(0.055, 0.10) + 0.5;
    for (int i = 0; i < 6; ++i) {
        sum += weight * tiledNoise(min(fract(q), 0.999999), ivec2(6) << i, 20 + i);
        q += 0.05 * sum;
        weight *= 0.55;
    }
    return sum;
}
// All round, over the horizon: sky, clouds, headlands.
void mainSky(out vec4 colour, in vec2 pixel) {
    vec2 uv = pixel / iResolution.xy;
    vec3 sun = sunDirection();
    float a = 2.0 * kPi * (uv.x - 0.5), v = min(uv.y / (1.0 - 0.5 / iResolution.y), 1.0);
    float up = v * v;
    vec3 rd = vec3(sqrt(1.0 - up * up) * sin(a), up, -sqrt(1.0 - up * up) * cos(a));
    float turned = abs(fract((a - radians(sunAngle)) / (2.0 * kPi) + 0.5) - 0.5) * 2.0;
    vec3 light = texture(air, vec2(turned, v * (1.0 - 0.5 / 128.0))).rgb
        + vec3(0.0010, 0.0019, 0.0052);
    // What lies low all round lights the clouds high up, not what lies low below them.
    float aside = mix(turned, 0.5, min(2.0 * up, 1.0));
    vec3 clear = texture(air, vec2(aside, 0.75)).rgb, low = texture(air, vec2(aside, 0.2)).rgb;
    float sum = cloudNoise(rd, up);
    float cover = mix(0.80, 0.22, clouds), thick = smoothstep(cover, cover + 0.22, sum);
    thick *= smoothstep(0.0, 0.05, up) * step(0.001, clouds);
    float towards = max(dot(rd, sun), 0.0);
    vec3 lit = sunColour() * (0.21 + 0.10 * pow(towards, 4.0) + 0.35 * pow(towards, 40.0));
    light = mix(light, 0.9 * clear + 0.25 * low + lit * (1.0 - 0.55 * thick), 0.85 * thick);
    // A lid of cloud: dark bellies, lighter towards the horizon.
    float grey = dot(clear + 0.5 * low, vec3(0.3)) + 0.04 * sunColour().g * max(sun.y, 0.0);
    vec3 lid = grey * vec3(0.74, 0.80, 0.86)
        * mix(0.75, 0.04 + 0.70 * smoothstep(0.2, 0.8, sum), smoothstep(0.0, 0.22, up));
    light = mix(light, lid * (1.0 - 0.55 * smoothstep(0.42, 0.72, sum)), overcast);
    float shore = smoothstep(0.06, 0.16, abs(fract(uv.x - sunAngle / 360.0) - 0.5));
    // Higher up there is no land; whole quads agree, for there are derivatives below.
    float hills = 0.0, rows = (2.0 * floor(0.5 * pixel.y) + 1.0) / iResolution.y;
    int ridges = square(rows) < 0.12 ? 3 : 0;
    for (int i = 0; i < 3; ++i) {   // each range nearer and darker than the one behind
        float n = float(i), land = 0.0;
        for (int j = 0; j < ridges; ++j) {
            float turns = j == 0 ? uv.x + 0.31 * n : (j == 1 ? 3.0 : 9.0) * uv.x;
            float gain = j == 0 ? 0.085 - 0.026 * n : j == 1 ? 0.020 : 0.007;
            land += gain * ridge(fract(turns), 1 + i + 4 * j);
        }
        // A texel is 0.18 degrees wide and far less high: a steep edge is as soft as it is wide, or
        // large pictures show its steps.
        float over = shore * land - 0.018 - up, soft = max(fwidth(over), 0.0010);
        float there = smoothstep(-soft, soft, over);
        there *= exp(-min((9.0 - 3.0 * n) * 500.0 / visibility, 60.0));
        light = mix(light, light * (vec3(0.60, 0.70, 0.80) - vec3(0.09, 0.07, 0.09) * n), there);
        hills = max(hills, there);
    }
    vec3 fog = 0.3 * low + 0.7 * dot(low + clear, vec3(1.0 / 6.0))
        + 0.05 * sunColour() * max(sun.y, 0.0);
    float seen = throughFog(up);
    light = mix(fog * (1.0 - 0.3 * overcast), light, seen);
    colour = vec4(min(light, 6e4), seen * (1.0 - hills) * (1.0 - 0.85 * thick) * (1.0 - overcast));
}

// What must not be computed at each pixel: clouds of noise, foam's lace, slope of the sand's
// ripples, wood's grain; all on a torus.
void mainMotif(out vec4 colour, in vec2 pixel) {
    vec2 unit = pixel / 512.0;
    float sum = 0.0, gain = 0.5, lace = 0.0;
    for (int k = 0; k < 6; ++k) {
        sum += gain * tiledNoise(unit, ivec2(4 << k), 81 + k);
        gain *= 0.5;
    }
    for (int k = 0; k < 3; ++k) {   // walls between the cells of scattered points
        int n = 14 << k;
        vec2 at = unit * float(n) + 1.2 * (sum - 0.5), c = floor(at), best = vec2(9.0);
        for (int j = 0; j < 9; ++j) {
            ivec2 cell = ivec2(c) + ivec2(j % 3 - 1, j / 3 - 1);
            vec2 d = vec2(cell) + random3(ivec3((cell + n) % n, 91 + k)).xy - at;
            float far = length(d);
            best = far < best.x ? vec2(far, best.x) : vec2(best.x, min(best.y, far));
        }
        lace += (k == 0 ? 0.45 : 0.275) * (1.0 - smoothstep(0.0, 0.45, best.y - best.x));
    }
    float phase = 2.0 * kPi * (27.0 * unit.x + 14.0 * unit.y) + 9.0 * sum;
    float wood = 0.5 * tiledNoise(unit, ivec2(160, 16), 95)
        + 0.5 * tiledNoise(unit, ivec2(48, 6), 96);
    colour = vec4(smoothstep(0.15, 0.85, sum), clamp(0.85 * lace + 0.5 * (sum - 0.3), 0.0, 1.0),
                  0.5 + 0.5 * cos(phase), wood);
}

// How high, and how much higher at the bow and on the port side, the sea stands under her, averaged
// over the hull, `back` seconds before now; the last two as angles.
vec3 hullTarget(vec2 place, float heading, float back) {
    vec2 ahead = vec2(sin(heading), -cos(heading)), port = vec2(ahead.y, -ahead.x);
    float sum = 0.0, bow = 0.0, side = 0.0;
    for (int i = 0; i < 8; ++i) {
        vec3 w = waveOf(i);
        float hz = waveHz(w.xy), kept = floor(hz * animation * 65536.0) / 65536.0;
        float phase = worldPhase(w.xy, place) + fract(float(i) * 0.7548777) - cycles(hz);
        phase += kept * back;
        for (int j = loopStart(); j < 9; ++j) {
            vec2 at = vec2(float(j % 3 - 1) * 0.50, float(j / 3 - 1) * 1.35);
            float c = cos(2.0 * kPi * phase + dot(w.xy, at.x * port + at.y * ahead));
            float h = w.z * (c + crest() * (2.0 * c * c - 1.0)) / 9.0;
            sum += h;
            bow += h * at.y * 1.5 / square(1.35);
            side += h * at.x * 1.5 / square(0.50);
        }
    }
    return vec3(sum, atan(bow), atan(side));
}
// One of heave, pitch and roll after a step: position, speed, and the last two targets. Heave is
// stiffest; aside: the hull's own lean and squat, which move the targets.
vec4 floated(vec4 own, int which, bool fresh, vec2 was, vec2 now, float heading, vec3 aside) {
    float stiff = stiffness * (which == 0 ? 1.0 : which == 1 ? 1.2 : 0.7);
    float loss = damping * (which == 2 ? 0.6 : 1.0);
    vec2 s = clamp(own.xy, vec2(-50.0, -5e4), vec2(50.0, 5e4));
    float before = own.z, older = own.w, dt = iTimeDelta, part = dt / float(substeps);
    for (int i = 1; i <= substeps; ++i) {
        float back = dt - float(i) * part;
        vec2 at = mix(now, was, back / dt);
        if (distance(now, was) > 100.0) at = now;   // over the world's edge
        float target = (hullTarget(at, heading, back) + aside)[which];
        if (fresh) {
            s = vec2(target, 0.0);
            before = older = target;
        }
        s = floatStep(s, stiff, loss, part, older, before, target);
        older = before;
        before = target;
        fresh = false;
    }
    return vec4(clamp(s, -5e4, 5e4), before, older);
}
float key(int code) { return step(0.5, texelFetch(keys, ivec2(code, 0), 0).x); }

// What the wind in her sail adds to her roll.
float heel(float heading) { return sail ? 0.10 * sin(radians(windAngle) - heading) : 0.0; }

// 0: place, heading (to the right), speed. 1: turning, rudder, what the camera lags, 1 once there
// is a state. 2 to 4: heave, pitch (bow up), roll (port up), each with its speed and two targets.
void mainBoat(out vec4 colour, in vec2 pixel) {
    int k = int(pixel.x);
    vec4 place = previousFrame(texelFetch(boat, ivec2(0), 0));
    vec4 way = previousFrame(texelFetch(boat, ivec2(1, 0), 0));
    vec4 own = previousFrame(texelFetch(boat, ivec2(k, 0), 0));
    bool fresh = abs(way.w - 1.0) > 0.01;
    if (fresh) {
        place = vec4(0.0, 0.0, radians(startHeading), 0.0);
        way = vec4(0.0, 0.0, 0.0, 1.0);
    }
    float dt = iTimeDelta, throttle = key(38) - key(40), helm = key(39) - key(37);
    float speed = clamp(place.w, -8.0, 8.0), turning = clamp(way.x, -2.0, 2.0);
    // Speed and turning follow with inertia, each exactly.
    float goal = topSpeed * (throttle < 0.0 ? 0.4 : 1.0) * throttle, lose = exp(-0.55 * dt);
    float steer = radians(turnRate) * helm * (0.25 + 0.75 * min(abs(speed) / topSpeed, 1.0));
    if (speed < -0.05) steer = -steer;
    float run = goal * dt + (speed - goal) * (1.0 - lose) / 0.55, keep = exp(-1.7 * dt);
    float swing = steer * dt + (turning - steer) * (1.0 - keep) / 1.7;
    vec2 now = place.xy + run * vec2(sin(place.z + 0.5 * swing), -cos(place.z + 0.5 * swing));
    now -= kWorld * floor(now / kWorld + 0.5);
    float heading = place.z + swing;
    heading -= 2.0 * kPi * floor(heading / (2.0 * kPi) + 0.5);
    if (k == 0) {
        colour = vec4(now, heading, goal + (speed - goal) * lose);
        return;
    }
    if (k == 1) {
        float lag = (clamp(way.z, -2.0, 2.0) + swing) * exp(-dt / 0.8);
        colour = vec4(steer + (turning - steer) * keep, mix(helm, way.y, exp(-5.0 * dt)), lag, 1.0);
        return;
    }
    vec3 aside = vec3(0.0, 0.016 * speed, heel(heading) + 0.05 * speed * turning);
    colour = floated(own, k - 2, fresh, place.xy, now, heading, aside);
}

// The wave equation on a torus of 192 cells that goes along with her: heights, their speed half a
// step before, foam. Each cell stays where it is in the world, so the wake stays behind; what moves
// is the window of 24 m round her. A cell that it leaves on one side is the one that it gains on
// the other: near the rim all is damped, so it comes in at rest. A texel is four cells in a row,
// west to east: what steps 240 times a second fetches half as much for a cell so.
vec4 fourCells(sampler2D of, vec2 place) { return previousFrame(fetch(of, place, vec2(48.0, 192.0))); }
// The sum of the neighbours of each of four cells.
vec4 neighbours(sampler2D of, vec2 place, vec4 here) {
    vec2 east = vec2(1.0, 0.0), north = vec2(0.0, 1.0);
    return vec4(here.yzw, fourCells(of, place + east).x)
        + vec4(fourCells(of, place - east).w, here.xyz)
        + fourCells(of, place + north) + fourCells(of, place - north);
}
vec4 square(vec4 x) { return x * x; }
vec4 only(int i) { return vec4(equal(ivec4(i), ivec4(0, 1, 2, 3))); }
void mainWake(out vec4 height, out vec4 rise, out vec4 foamed, in vec2 pixel) {
    float cell = kWindow / 192.0, dt = iTimeDelta;
    vec2 c = floor(pixel);
    vec4 place = texelFetch(boat, ivec2(0), 0), here = fourCells(wake, c);
    vec4 sum = neighbours(wake, c, here), white = fourCells(wakeFoam, c);
    vec2 ahead = vec2(sin(place.z), -cos(place.z));
    vec4 x = (4.0 * pixel.x + vec4(-1.5, -0.5, 0.5, 1.5)) * cell - place.x;
    float y = pixel.y * cell - place.y;
    x -= kWindow * floor(x / kWindow + 0.5);
    y -= kWindow * floor(y / kWindow + 0.5);
    vec4 rim = smoothstep(0.38, 0.49, max(abs(x), abs(y)) / kWindow);
    vec4 kept = exp(-dt * (0.40 + 30.0 * rim * rim));
    vec4 along = x * ahead.x + y * ahead.y, across = x * ahead.y - y * ahead.x;
    vec4 side = across * across;
    float speed = place.w, power = min(square(speed / 2.4), 2.0);
    // She lifts the water before her and leaves a hollow behind.
    vec4 push = exp(-min((square(along - 1.7) + side) / 0.22, 40.0))
        - exp(-min((square(along + 1.7) + side) / 0.22, 40.0));
    float beat = 0.45 + 0.75 * sin(2.0 * kPi * cycles(1.125));   // as she nods, so crests follow
    vec4 drive = 2.2 * wakeStrength * power * sign(speed) * push * beat;
    rise = kept * fourCells(wakeRise, c)
        + dt * (square(kWakeSpeed / cell) * (sum - 4.0 * here) + drive);
    height = clamp(kept * (here + dt * rise), -0.4, 0.4);
    rise = clamp(rise, -8.0, 8.0);
    vec4 churn = 2.2 * exp(-min(square(along + 2.2) / 0.15 + side / 0.07, 40.0))
        + 1.5 * exp(-min(square(along - 1.2) / 0.4 + square(abs(across) - 0.62) / 0.012, 40.0));
    foamed = mix(white, 0.25 * neighbours(wakeFoam, c, white), 0.012)
        * exp(-dt * (0.22 + 20.0 * rim));
    // Above 3.4 m/s power grows no more, but she is over a cell for less and less time.
    foamed += dt * churn * min(wakeStrength, 1.5) * power * max(abs(speed) / 3.4, 1.0);
    foamed = clamp(foamed, 0.0, 1.0);
}
// The wake between the cells: slopes of a cubic B-spline of its heights, foam, height.
void mainRelief(out vec4 colour, in vec2 pixel) {
    float cell = kWindow / 192.0;
    vec3 row = vec3(0.0), column = vec3(0.0), weight = vec3(1.0, 4.0, 1.0) / 6.0;
    vec2 mean = vec2(0.0);
    int x = int(pixel.x), west = x - 1, east = x + 1;   // three cells in no more than two texels
    vec4 pick[3] = vec4[3](only(west & 3), only(x & 3), only(east & 3));
    for (int j = 0; j < 3; ++j) {
        vec2 left = vec2(west >> 2, int(pixel.y) + j - 1), right = vec2(east >> 2, left.y);
        vec4 foam[3], high[3];
        foam[0] = fourCells(wakeFoam, left), foam[2] = fourCells(wakeFoam, right);
        high[0] = fourCells(wake, left), high[2] = fourCells(wake, right);
        bool within = (x & 3) == 0;
        foam[1] = within ? foam[2] : foam[0];
        high[1] = within ? high[2] : high[0];
        for (int i = 0; i < 3; ++i) {
            vec2 w = vec2(dot(foam[i], pick[i]), dot(high[i], pick[i]));
            row[i] += weight[j] * w.y;
            column[j] += weight[i] * w.y;
            mean += weight[i] * weight[j] * w;
        }
    }
    colour = vec4((row.z - row.x) / (2.0 * cell), (column.z - column.x) / (2.0 * cell), mean);
}

// This frame's waves, four to a group: kx, kz (rad/m), height (m), phase at the boat (rad);
// then the heights by which the longest twelve gather light on the floor.
void mainWavelets(out vec4 colour, in vec2 pixel) {
    bool lens = pixel.x > 20.0;
    int group = lens ? int(pixel.x) - 20 : int(pixel.x) >> 2, kind = int(pixel.x) & 3;
    vec2 place = previousFrame(texelFetch(boat, ivec2(0), 0)).xy;
    for (int c = loopStart(); c < 4; ++c) {
        int i = 4 * group + c;
        vec3 w = waveOf(i);
        float phase = worldPhase(w.xy, place) + fract(float(i) * 0.7548777) - cycles(waveHz(w.xy));
        colour[c] = kind < 2 ? w[kind] : kind == 2 ? w.z : 2.0 * kPi * (phase - floor(phase));
        if (lens) colour[c] = w.z * exp(-min(dot(w.xy, w.xy) * square(0.018 * depth), 40.0));
    }
}

// Small buffers know by it how large the picture is, in whose pixels the mouse counts. Drawn once.
void mainScreen(out vec4 colour, in vec2 pixel) { colour = vec4(0.0); }

// 0 to 2: the boat's axes, with heave, boom and rudder; 3 to 6: the eye: place, right, up, forward;
// 7: her place in the world, heading.
void mainPoses(out vec4 colour, in vec2 pixel) {
    loadWavelets();
    int k = int(pixel.x);
    vec4 place = previousFrame(texelFetch(boat, ivec2(0), 0));
    vec4 way = previousFrame(texelFetch(boat, ivec2(1, 0), 0));
    vec3 tilt;
    for (int i = 0; i < 3; ++i) tilt[i] = previousFrame(texelFetch(boat, ivec2(2 + i, 0), 0)).x;
    if (way.w < 0.5) {   // before the first step
        place = vec4(0.0, 0.0, radians(startHeading), 0.0);
        tilt = hullTarget(place.xy, place.z, 0.0);
        tilt.z += heel(place.z);
    }
    tilt = clamp(tilt, vec3(-20.0, -1.3, -1.3), vec3(20.0, 1.3, 1.3));
    vec3 level = vec3(sin(place.z), 0.0, -cos(place.z)), aside = vec3(level.z, 0.0, -level.x);
    vec3 up = vec3(0.0, 1.0, 0.0), z = cos(tilt.y) * level + sin(tilt.y) * up;
    vec3 y = cos(tilt.y) * up - sin(tilt.y) * level, x = cos(tilt.z) * aside + sin(tilt.z) * y;
    y = cos(tilt.z) * y - sin(tilt.z) * aside;
    float wind = radians(windAngle) - place.z;
    float boom = -0.85 * sin(wind) * (0.78 + 0.22 * cos(wind));
    boom += 0.01 * sin(2.0 * kPi * cycles(0.75));

    bool dragged = iMouse != vec4(0.0);   // the middle of the picture is the camera's own place
    vec2 orbit = dragged ? iMouse.xy / vec2(textureSize(screen, 0)) - 0.5 : vec2(0.0);
    float angle = radians(cameraAngle) - 2.0 * kPi * orbit.x - (chase ? place.z - way.z : 0.0);
    vec3 eye = cameraDistance * vec3(sin(angle), 0.0, cos(angle));
    eye.y = max(clamp(cameraHeight - 6.0 * orbit.y, 0.3, 20.0), moversAt(eye.xz) + 0.25);
    vec3 to = targetShift * vec3(cos(angle), 0.0, -sin(angle)), head = up;
    vec3 forward = to + vec3(0.0, targetHeight + 0.35 * tilt.x, 0.0) - eye;
    if (firstPerson) {
        eye = vec3(0.0, tilt.x, 0.0) + 0.16 * x + 1.12 * y - 1.28 * z;
        forward = normalize(mix(z, level, steadiness));
        head = normalize(mix(y, up, steadiness));
        float look = radians(cameraAngle) - kPi * orbit.x, nod = 1.2 * orbit.y - 0.11;
        vec3 left = cross(head, forward);
        forward = normalize(cos(look) * forward + sin(look) * left + tan(nod) * head);
    }
    forward = normalize(forward);
    vec3 right = normalize(cross(forward, head));
    head = cross(right, forward);
    colour = k == 0 ? vec4(x, tilt.x) : k == 1 ? vec4(y, boom) : k == 2 ? vec4(z, 0.5 * way.y)
        : k == 3 ? vec4(eye, 0.0) : k == 4 ? vec4(right, 0.0) : k == 5 ? vec4(head, 0.0)
        : k == 6 ? vec4(forward, 0.0) : vec4(place.xyz, 0.0);
}

// ---- Image --------------------------------------------------------------------------------------
// The eye stands in `poses`; here are only its rays, spread over the pixel.
// Dither of one step of 255 hides the bands of an evening sky. All samples of a pixel have the same:
// their mean is rounded to one of the 255, and of many different ones nothing would be left by then.

// Light to display: clamped first, then the largest channel rolls off, the others keep their ratio
// to it, with a little white at the top as on film; then sRGB. NaN and negatives 0, infinity 1.
vec3 display(vec3 light) {
    vec3 x = mix(vec3(0.0), min(light, 65504.0), greaterThan(light, vec3(0.0)));
    float peak = max(maxComponent(x), 1e-6), rolled = 1.0 - exp(-peak);
    vec3 c = mix(x * (rolled / peak), vec3(rolled), 0.35 * pow(rolled, 12.0));
    c = clamp(c, 0.0, 1.0);
    return mix(12.92 * c, 1.055 * pow(max(c, 1e-6), vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c));
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    loadWavelets();
    loadBoat();
    Eye e = Eye(texelFetch(poses, ivec2(3, 0), 0).xyz, texelFetch(poses, ivec2(4, 0), 0).xyz,
                texelFetch(poses, ivec2(5, 0), 0).xyz, texelFetch(poses, ivec2(6, 0), 0).xyz,
                focalLength / 24.0);
    vec3 chance = random3(ivec3(ivec2(fragCoord * 16.0), 3)), sum = vec3(0.0);
    for (int i = 0; i < antialias; ++i) {   // the first in the middle of the pixel
        vec2 aside = fract(0.5 + float(i) * vec2(0.75487767, 0.56984029)) - 0.5;
        vec3 rd = viewRay(e, fragCoord + aside);
        sum += render(e, rd, 1.0 / (e.lens * iResolution.y), fract(chance.x + float(i) * kGolden));
    }
    vec3 one = random3(ivec3(16 * ivec2(fragCoord) + 8, 3)), dither = (one + one.yzx - 1.0) / 255.0;
    fragColor = vec4(display(exp2(exposure) * sum / float(antialias)) + 0.5 * dither, 1.0);
}
