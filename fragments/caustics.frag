// Caustics: light on the floor of a pool.
//
// Sunlight through a moving surface draws dancing filaments on sand or tiles, on what stands there,
// and as shafts in the blue-green water. Five methods draw them on the same water, floor and light,
// from the classic shortcut to photons that are gathered without bound.
//
// Method   A map holds, for each texel of the floor, the light that falls into it relative to flat
//          water. Nothing can be drawn forward here, so forward methods are turned round: a pass
//          stores where the light of each surface cell lands, two levels of boxes over the cells
//          find those that can reach a texel, and the exact area of overlap shares each triangle's
//          flux among texels (area), or each cell's photon counts where it lands (photons: exact in
//          expectation). Light is conserved in both. Calm water needs one inverse search and 1/|J|.
//          The same at four depths lights objects and the water itself.
// Sources  Stam, SIGGRAPH sketches (1996): periodic tiles. Guardado and Sanchez-Crespo, GPU Gems
//          ch. 2 (2004): the shortcuts. Born and Wolf, Principles of Optics, 1.5: Snell, Fresnel.
//          Daimon and Masumura, Appl. Opt. 46 (2007): indices of water. Jarzynski and Olano, JCGT
//          9(3) (2020): pcg3d. Henyey and Greenstein, ApJ 93 (1941): phase function.
// Units    1 unit = 1 m, y up, linear sRGB colour; the floor lies at y = 0.
// Passes   waves, sand: on change of a tweak. surface, landing, boxes, map, slices: every frame.
//          frame...: the loop of the periodic method, on change of a tweak. clock: photons only.
// Licence  MIT

// ---- Tweaks -------------------------------------------------------------------------------------
//@ group Water
uniform float depth;           //@ 2.2 [0.5, 6] unit=m "of the water"
uniform float waveLength;      //@ 0.9 [0.3, 2.5] log unit=m "of the strongest waves"
uniform float waveSlope;       //@ 0.09 [0, 0.3] "root mean square; 0 is a mirror"
uniform float spread;          //@ 1.0 [0, 1] "of the waves' directions: 0 one way, 1 all round"
uniform float windAngle;       //@ 25 [-180, 180] unit=deg "where the waves go"
uniform float animation;       //@ 1.0 [0, 4] "speed of everything that moves"
uniform vec3  waterTint;       //@ #6ecbe0 "what white light becomes over the distance below"
uniform float tintDistance;    //@ 6.0 [0.5, 50] log unit=m "that light goes to take on the tint"
uniform float haze;            //@ 0.06 [0, 0.5] unit=1/m "light scattered out of its way"
//@ group Light
uniform int   method;          //@ 3 {vertical, snell, periodic, area, photons} quality reference=photons "how light finds the floor"
uniform int   folds;           //@ 0 {automatic, never, always} "area: 1/|J| where none is, or a mesh"
uniform float sunElevation;    //@ 55 [15, 90] unit=deg "above the horizon"
uniform float sunAngle;        //@ 0 [-180, 180] unit=deg "round the axis; 0 is ahead"
uniform float sunPower;        //@ 6.0 [0, 10] "irradiance of a face towards the sun"
uniform float skyLight;        //@ 1.0 [0, 2] "of the open sky"
uniform float dispersion;      //@ 1.0 [0, 8] "spread of the colours; 1 is true"
uniform float shafts;          //@ 1.0 [0, 4] "contrast of the light in the water"
uniform float contrast;        //@ 24 [1, 256] log "vertical, snell: exponent of that style"
uniform float periodicSeconds; //@ 2.0 [0.5, 8] unit=s "periodic: length of the loop"
//@ group Floor
uniform int   ground;          //@ 0 {sand, tiles} "what lies below; tiles have walls"
uniform int   objects;         //@ 1 {none, toys, ruin} "what stands on it"
//@ group Camera
uniform float cameraDistance;  //@ 3.2 [0, 8] unit=m "from the axis"
uniform float cameraAngle;     //@ 0 [-180, 180] unit=deg "round the axis"
uniform float cameraHeight;    //@ 0.6 [0.05, 5.9] unit=m "of the eye"
uniform float targetHeight;    //@ 0.8 [0, 4] unit=m "of the point looked at"
uniform float targetShift;     //@ 0.0 [-4, 4] unit=m "eye and point to the right"
uniform float focalLength;     //@ 22 [12, 120] log unit=mm "of a lens on 36 x 24 mm film"
uniform float exposure;        //@ 0.0 [-4, 4] unit=stop "before the display curve"
//@ group Quality
uniform int   cells;           //@ 128 [64, 256] log quality reference=256 "of the mesh, a side"
uniform int   rootSteps;       //@ 2 [0, 16] quality reference=16 "1/|J|: steps of the search"
uniform int   shaftSamples;    //@ 8 [1, 256] log quality reference=256 "along one view ray"

precision highp sampler2D;     // the default is lowp: Mesa then reads 32-bit buffers as halves
uniform sampler2D sand;          //@ pass mainSand size=512x512 wrap=repeat filter=mipmap
uniform sampler2D waves;         //@ pass mainWaves size=16x1
uniform sampler2D surface;       //@ pass mainSurface size=256x256 wrap=repeat filter=mipmap
uniform sampler2D clock;         //@ pass mainClock size=1x1
uniform sampler2D landing;       //@ pass mainLanding size=256x256
uniform sampler2D split;         //@ pass mainLanding size=256x256
uniform sampler2D cellBoxes;     //@ pass mainCells size=256x256
uniform sampler2D blocks;        //@ pass mainBlocks size=64x64
uniform sampler2D supers;        //@ pass mainSupers size=16x16
uniform sampler2D reach;         //@ pass mainReach size=1x1
uniform sampler2D frameLanding;  //@ pass mainFrameLanding size=512x512
uniform sampler2D frameSplit;    //@ pass mainFrameLanding size=512x512
uniform sampler2D frameCells;    //@ pass mainFrameCells size=512x512
uniform sampler2D frameBlocks;   //@ pass mainFrameBlocks size=128x128
uniform sampler2D frameSupers;   //@ pass mainFrameSupers size=32x32
uniform sampler2D frameReach;    //@ pass mainFrameReach size=4x4
uniform sampler2D frames;        //@ pass mainFrames size=1024x1024
uniform sampler2D caustics;      //@ pass mainCaustics size=256x256 wrap=repeat filter=mipmap
uniform sampler2D slices;        //@ pass mainSlices size=128x128 wrap=repeat filter=mipmap

// ---- Constants and numbers ----------------------------------------------------------------------
const float kPi = 3.14159265358979;
const float kGolden = 0.61803398874989;
const float kTile = 4.5;                   // m, side of the square after which the water repeats
const int   kWaves = 12;
const float kGravity = 9.81;               // m/s^2
const vec3  kIorWater = vec3(1.3317, 1.3345, 1.3384);   // 630, 546 and 465 nm at 20 C
const int   kVertical = 0, kSnell = 1, kPeriodic = 2, kArea = 3, kPhotons = 4;
const int   kMap = 256, kSliceMap = 128;   // texels a side: of the floor, of a level of the water
const int   kPhotonCells = 256, kFrameCells = 128, kFrames = 16;
const vec4  kFalls = vec4(0.25, 0.5, 0.75, 1.0);   // levels of the slices, parts of the depth
const float kFar = 1e9;                    // m, a miss
const float kSandTile = 2.25;              // m
const vec2  kPool = vec2(4.2, 7.5);        // m, half width and half length, with tiles

uvec3 hash3(ivec3 q) {
    uvec3 v = uvec3(q) * 1664525u + 1013904223u;
    v.x += v.y * v.z; v.y += v.z * v.x; v.z += v.x * v.y; v ^= v >> 16u;
    v.x += v.y * v.z; v.y += v.z * v.x; v.z += v.x * v.y; return v;
}
vec3 random3(ivec3 q) { return vec3(hash3(q) >> 8u) / 16777216.0; }

// Cycles since the start, modulo 1, of a motion; its frequency is cut to a multiple of 1/65536 Hz.
float cycles(float hz) { return float(uint(hz * animation * 65536.0) * iTick) / 4294967296.0; }

float maxComponent(vec3 v) { return max(v.x, max(v.y, v.z)); }
float square(float x) { return x * x; }
vec3 linearColour(vec3 c) {   // from sRGB, a fit to 1/500
    return c * (c * (c * 0.305306011 + 0.682171111) + 0.012522878);
}
vec2 turn(vec2 p, float angle) {
    float c = cos(angle), s = sin(angle);
    return vec2(c * p.x + s * p.y, c * p.y - s * p.x);
}
vec4 previousFrame(vec4 p) { return mix(vec4(0.0), p, lessThanEqual(abs(p), vec4(6e4))); }   // NaN compares false
float fogIntegral(float x) {                                                                 // (1 - exp(-x)) / x
    return abs(x) < 0.02 ? 1.0 - x * 0.5 * (1.0 - x / 3.0 * (1.0 - x * 0.25)) : (1.0 - exp(-clamp(x, -80.0, 80.0))) / x;
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

// ---- Water --------------------------------------------------------------------------------------
struct Water { float height; vec2 slope; vec3 curve; };   // m; 1; xx, xz and zz, 1/m

// The water over a point of the tile, in tiles; now, or in a frame of the loop.
Water waterAt(vec2 u, bool now, int frame) {
    Water water = Water(0.0, vec2(0.0), vec3(0.0));
    for (int i = 0; i < kWaves; ++i) {
        vec4 wave = texelFetch(waves, ivec2(i, 0), 0);   // whole waves in the tile, slope, Hz
        float turns = now ? cycles(wave.w)
            : fract(max(floor(wave.w * periodicSeconds + 0.5), 1.0) * float(frame) / 16.0);
        float phase = 2.0 * kPi * (fract(dot(wave.xy, u) - turns) + fract(kGolden * float(i * i)));
        vec2 k = 2.0 * kPi / kTile * wave.xy;            // 1/m
        float number = max(length(k), 1e-6), s = sin(phase), c = cos(phase);
        water.height += wave.z / number * s;
        water.slope += wave.z / number * c * k;
        water.curve -= wave.z / number * s * vec3(k.x * k.x, k.x * k.y, k.y * k.y);
    }
    return water;
}

vec3 towardsSun() {
    float e = radians(min(sunElevation, 89.99)), a = radians(sunAngle);
    return vec3(sin(a) * cos(e), sin(e), -cos(a) * cos(e));
}

// Snell's law for the sun: metres aside per metre of depth under a slope, and its derivative. The
// refracted ray is eta * incident - along * normal, with a normal (-slope.x, 1, -slope.y) of any length.
vec2 bend(vec2 slope, float ior, out mat2 derivative) {
    vec3 i = -towardsSun();
    float eta = 1.0 / ior, k = (1.0 - eta) * (1.0 + eta);
    float m = i.y - dot(i.xz, slope), q = 1.0 + dot(slope, slope);
    float root = sqrt(q * k + eta * eta * m * m);
    float along = (eta * m + root) / q;
    vec2 across = eta * i.xz + along * slope;
    float down = max(along - eta * i.y, 0.1);            // a slope of 1 leaves 0.2
    vec2 growth = ((k * slope - eta * eta * m * i.xz) / root - eta * i.xz - 2.0 * along * slope) / q;
    derivative = (mat2(along) + outerProduct(slope, growth)) / down
        - outerProduct(across, growth) / (down * down);
    return across / down;
}

// Light that passes a level square metre of surface, relative to flat water.
float fluxThrough(vec2 slope) {
    vec3 sun = towardsSun();
    float facing = max(sun.y - dot(sun.xz, slope), 0.0);
    float share = 1.0 - fresnel(min(facing * inversesqrt(1.0 + dot(slope, slope)), 1.0), kIorWater.y);
    return facing / sun.y * share / (1.0 - fresnel(sun.y, kIorWater.y));
}

vec3 refractiveIndices() {
    return kIorWater.y + dispersion * (kIorWater - kIorWater.y);
}

// Where light that enters at u lands, as tiles from where flat water would send it; and its flux.
// pair: the same for red and blue.
void landAt(vec2 u, bool now, int frame, out vec4 middle, out vec4 pair) {
    Water water = waterAt(u, now, frame);
    mat2 unused;
    vec3 ior = refractiveIndices();
    vec2 level = depth * bend(vec2(0.0), ior.y, unused);
    float fall = depth + water.height;
    middle.xy = fall * bend(water.slope, ior.y, unused) - level;
    middle.zw = vec2(fluxThrough(water.slope) * kTile, 0.0);
    pair.xy = fall * bend(water.slope, ior.x, unused) - level;
    pair.zw = fall * bend(water.slope, ior.z, unused) - level;
    middle = clamp(middle / kTile, -2.0, 2.0);
    pair = clamp(pair / kTile, -2.0, 2.0);
}

// Where in its cell a photon starts: an R2 sequence (Roberts 2018), shifted by a hash of the cell.
vec2 photonStart(ivec2 cell, int pass) {
    uvec2 shift = hash3(ivec3(cell, 7)).xy;
    return vec2((shift + uint(pass) * uvec2(3242174889u, 2447445414u)) >> 8u) / 16777216.0;
}

ivec2 wrapped(ivec2 i, int period) { return i - period * ivec2(floor((vec2(i) + 0.5) / float(period))); }
int meshCells() { return method == kPhotons ? kPhotonCells : cells / 16 * 16; }
int photonPass() { return method == kPhotons ? int(texelFetch(clock, ivec2(0), 0).w) : 0; }

// ---- Gathering ----------------------------------------------------------------------------------
// A box, in tiles from its own corner, round the landings of count x count children.
vec4 boxOf(sampler2D children, ivec2 first, ivec2 origin, int count, int period, float side) {
    vec4 box = vec4(1e3, 1e3, -1e3, -1e3);
    for (int k = 0; k < count * count; ++k) {
        ivec2 step = ivec2(k % count, k / count);
        vec4 child = texelFetch(children, origin + wrapped(first + step, period), 0);
        child += side * vec2(step).xyxy;
        box = vec4(min(box.xy, child.xy), max(box.zw, child.zw));
    }
    return box;
}

// A box round the landings of a cell's corners, all colours, or of its photon.
vec4 landingBox(sampler2D at, sampler2D pairs, ivec2 cell, ivec2 origin, int count, int pass) {
    vec4 box = vec4(1e3, 1e3, -1e3, -1e3);
    for (int k = 0; k < (method == kPhotons ? 1 : 4); ++k) {
        ivec2 step = ivec2(k & 1, k >> 1), place = origin + wrapped(cell + step, count);
        vec2 home = (method == kPhotons ? photonStart(cell, pass) : vec2(step)) / float(count);
        vec4 middle = texelFetch(at, place, 0), pair = middle.xyxy;
        if (dispersion > 0.0) pair = texelFetch(pairs, place, 0);
        box.xy = min(box.xy, home + min(middle.xy, min(pair.xy, pair.zw)));
        box.zw = max(box.zw, home + max(middle.xy, max(pair.xy, pair.zw)));
    }
    return box;
}

// Integral over the height of the unit square of the part of its width right of an edge; signed.
float rightOf(vec2 a, vec2 b) {
    vec2 y = clamp(vec2(a.y, b.y), 0.0, 1.0);
    float rise = b.y - a.y;
    float lean = abs(rise) > 1e-6 ? (b.x - a.x) / rise : 0.0;
    vec2 x = a.x + (y - a.y) * lean, left = min(x, 0.0), inside = clamp(x, 0.0, 1.0);
    float run = x.y - x.x;
    float mean = left.y - left.x + (inside.y - inside.x) * (1.0 - 0.5 * (inside.x + inside.y));
    mean = abs(run) > 1e-3 ? mean / run : clamp(1.0 - 0.5 * (x.x + x.y), 0.0, 1.0);
    return (y.y - y.x) * mean;
}

// Part of a triangle's light that falls into the unit square, over its area; edges: sum of rightOf.
float triangleLight(vec2 a, vec2 b, vec2 c, float edges) {
    float area = 0.5 * determinant(mat2(b - a, c - a));
    vec2 middle = (a + b + c) / 3.0;   // where all the light of a sliver goes
    float inside = all(greaterThanEqual(middle, vec2(0.0))) && all(lessThan(middle, vec2(1.0))) ? 1.0 : 0.0;
    return abs(area) > 1e-3 ? -edges / area : inside;
}

// The same of a cell with corners a, b, c, d in rows, each half with the flux of its corners.
float cellLight(vec2 a, vec2 b, vec2 c, vec2 d, vec4 flux) {
    vec2 lo = min(min(a, b), min(c, d)), hi = max(max(a, b), max(c, d));
    if (any(greaterThanEqual(lo, vec2(1.0))) || any(lessThanEqual(hi, vec2(0.0)))) return 0.0;
    float middle = rightOf(b, c);
    return triangleLight(a, b, c, rightOf(a, b) + middle + rightOf(c, a)) * (flux.x + flux.y + flux.z) / 6.0
        + triangleLight(d, c, b, rightOf(d, c) - middle + rightOf(b, d)) * (flux.y + flux.z + flux.w) / 6.0;
}

struct Corner { vec2 middle, red, blue; float flux; };
Corner cornerAt(sampler2D at, sampler2D pairs, ivec2 origin, ivec2 cell, int count, vec2 corner,
                float zoom, float fall, bool coloured) {
    ivec2 place = origin + wrapped(cell, count);
    vec4 middle = texelFetch(at, place, 0), pair = vec4(0.0);
    vec2 home = vec2(cell) / float(count) - corner;
    if (coloured) pair = texelFetch(pairs, place, 0);
    return Corner(zoom * (home + fall * middle.xy), zoom * (home + fall * pair.xy),
                  zoom * (home + fall * pair.zw), middle.z);
}

bool meets(vec4 box, vec2 corner, vec2 end) {
    return all(lessThanEqual(box.xy, end)) && all(greaterThanEqual(box.zw, corner));
}
vec4 boxAt(sampler2D boxes, ivec2 origin, ivec2 place, int count, float fall) {
    float side = 1.0 / float(count);
    vec4 box = texelFetch(boxes, origin * count + wrapped(place, count), 0);
    return mix(vec4(0.0, 0.0, side, side), box, fall) + side * vec2(place).xyxy;
}

int lowestBit(int mask) { return int(log2(float(mask & -mask)) + 0.5); }

// Light that falls into a square of the floor, or of a level at a part `fall` of the depth, relative
// to flat water. The cells that can reach it are found through two levels of boxes.
vec3 gather(sampler2D at, sampler2D pairs, sampler2D boxes0, sampler2D boxes1, sampler2D boxes2, vec4 bounds, ivec2 frame,
            int count, vec2 corner, float size, float fall, bool coloured) {
    int pass = photonPass();
    float side = 16.0 / float(count), zoom = 1.0 / size, share = square(zoom / float(count));
    vec2 end = corner + size;
    bounds = mix(vec4(0.0, 0.0, side, side), bounds, fall);
    ivec2 first = ivec2(ceil((corner - bounds.zw) / side)), last = ivec2(floor((end - bounds.xy) / side));
    ivec2 span = clamp(last - first + 1, 0, 96);
    vec3 sum = vec3(0.0);
    int k = 0;
    for (int turn = 0; turn < span.x * span.y; ++turn) {
        bool found = false;
        ivec2 s;
        for (; k < span.x * span.y && !found; ++k) {
            s = first + ivec2(k % span.x, k / span.x);
            found = meets(boxAt(boxes2, frame, s, count / 16, fall), corner, end);
        }
        if (!found) break;
        int hits = 0;
        for (int j = 0; j < 16; ++j) {
            ivec2 b = s * 4 + ivec2(j & 3, j >> 2);
            if (meets(boxAt(boxes1, frame, b, count / 4, fall), corner, end)) hits |= 1 << j;
        }
        for (; hits != 0; hits &= hits - 1) {
            int j = lowestBit(hits), cellHits = 0;
            ivec2 block = (s * 4 + ivec2(j & 3, j >> 2)) * 4;
            for (int j = 0; j < 16; ++j) {
                ivec2 cell = block + ivec2(j & 3, j >> 2);
                if (method == kPhotons) {
                    Corner p = cornerAt(at, pairs, frame * count, cell, count, corner, zoom, fall, coloured);
                    vec2 start = photonStart(wrapped(cell, count), pass) * (zoom / float(count));
                    vec2 m = p.middle + start;
                    vec3 hit = vec3(all(greaterThanEqual(m, vec2(0.0))) && all(lessThan(m, vec2(1.0))));
                    if (coloured) {
                        vec2 r = p.red + start, blue = p.blue + start;
                        hit.x = float(all(greaterThanEqual(r, vec2(0.0))) && all(lessThan(r, vec2(1.0))));
                        hit.z = float(all(greaterThanEqual(blue, vec2(0.0))) && all(lessThan(blue, vec2(1.0))));
                    }
                    sum += share * p.flux * hit;
                } else {
                    if (meets(boxAt(boxes0, frame, cell, count, fall), corner, end)) cellHits |= 1 << j;
                }
            }
            for (; cellHits != 0; cellHits &= cellHits - 1) {
                int j = lowestBit(cellHits);
                ivec2 cell = block + ivec2(j & 3, j >> 2);
                Corner a = cornerAt(at, pairs, frame * count, cell, count, corner, zoom, fall, coloured);
                Corner b = cornerAt(at, pairs, frame * count, cell + ivec2(1, 0), count, corner, zoom, fall, coloured);
                Corner c = cornerAt(at, pairs, frame * count, cell + ivec2(0, 1), count, corner, zoom, fall, coloured);
                Corner d = cornerAt(at, pairs, frame * count, cell + 1, count, corner, zoom, fall, coloured);
                vec4 flux = share * vec4(a.flux, b.flux, c.flux, d.flux);
                vec3 light = vec3(cellLight(a.middle, b.middle, c.middle, d.middle, flux));
                if (coloured) {
                    light.x = cellLight(a.red, b.red, c.red, d.red, flux);
                    light.z = cellLight(a.blue, b.blue, c.blue, d.blue, flux);
                }
                sum += light;
            }
        }
    }
    return sum;
}

// Calm water: where light lands has one origin, found by fixed-point steps; its light spreads over
// |J| times its area. J is the derivative of the landing, exact.
float inverseLight(vec2 u, float fall) {
    mat2 bending;
    vec2 level = fall * depth * bend(vec2(0.0), kIorWater.y, bending), at = u;
    Water water = waterAt(at, true, 0);
    for (int i = 0; i < rootSteps; ++i) {
        vec2 aside = bend(water.slope, kIorWater.y, bending) * (fall * depth + water.height) - level;
        at = u - aside / kTile;
        water = waterAt(at, true, 0);
    }
    vec2 aside = bend(water.slope, kIorWater.y, bending);
    mat2 curve = mat2(water.curve.xy, water.curve.yz);
    mat2 j = mat2(1.0) + (fall * depth + water.height) * bending * curve + outerProduct(aside, water.slope);
    return fluxThrough(water.slope) / max(abs(determinant(j)), 1e-3);
}
// Whether light can cross before it reaches the floor: depth times curvature times (1 - 1/n).
bool isCalm() {
    float curvature = 1.7 * 2.0 * kPi / waveLength * waveSlope;   // 1/m, root mean square
    return folds == 1 || (folds == 0 && depth * curvature * 0.25 < 0.12 * towardsSun().y);
}

// ---- Objects ------------------------------------------------------------------------------------
float torus(vec3 p, float r, float thick) { return length(vec2(length(p.xz) - r, p.y)) - thick; }

// A fluted drum of a column along y, with rounded edges.
float drum(vec3 p, float r, float halfHeight) {
    float a = atan(p.x, p.z + 1e-6);
    float flute = 0.022 * abs(cos(9.0 * a));
    vec2 d = vec2(length(p.xz) - r - flute + 0.022, abs(p.y) - halfHeight) + 0.02;
    return 0.8 * (length(max(d, 0.0)) + min(max(d.x, d.y), 0.0) - 0.02);
}
float starfish(vec3 p) {
    float a = atan(p.x, p.z + 1e-6), sector = 2.0 * kPi / 5.0;
    a = abs(mod(a + 0.5 * sector, sector) - 0.5 * sector);
    vec2 q = length(p.xz) * vec2(cos(a), sin(a));
    float along = clamp(q.x / 0.24, 0.0, 1.0), r = mix(0.07, 0.014, along);
    vec3 d = vec3(q.x - 0.24 * along, q.y, 1.6 * p.y);
    return 0.6 * (length(d) - r);
}
// Distance to the nearest object, and which.
vec2 map(vec3 p) {
    vec2 d = vec2(kFar, 0.0);
    if (objects == 1) {
        d = vec2(length(p - vec3(0.62, 0.27, -0.25)) - 0.27, 1.0);
        float ring = torus(p - vec3(-0.55, 0.06, 0.25), 0.30, 0.06);
        if (ring < d.x) d = vec2(ring, 2.0);
        vec3 q = p - vec3(-0.95, 0.33, -0.55);
        q.xz = turn(q.xz, 0.7);
        q.yz = turn(q.yz, 1.25);
        ring = torus(q, 0.30, 0.06);
        if (ring < d.x) d = vec2(ring, 3.0);
    } else if (objects == 2) {
        vec3 q = p - vec3(-0.95, 0.75, -0.6);
        q.xy = turn(q.xy, 0.05);
        float column = max(drum(q, 0.27, 0.85), dot(q, vec3(0.36, 0.9, 0.25)) - 0.62);
        column = min(column, drum(p - vec3(-0.95, 0.02, -0.6), 0.38, 0.07));
        q = p - vec3(0.85, 0.21, -0.15);
        q.xz = turn(q.xz, 0.5);
        q.yz = turn(q.yz, 0.5 * kPi - 0.08);
        d = vec2(min(column, drum(q, 0.26, 0.42)), 4.0);
        q = p - vec3(0.1, 0.015, 0.75);
        q.xz = turn(q.xz, 0.4);
        float star = starfish(q);
        if (star < d.x) d = vec2(star, 5.0);
    }
    return d;
}
// Where a ray is inside the box round all objects.
vec2 objectSpan(vec3 ro, vec3 rd) {
    if (objects == 0) return vec2(0.0, -1.0);
    vec3 inverse = 1.0 / mix(rd, vec3(1e-9), lessThan(abs(rd), vec3(1e-9)));
    vec3 lo = objects == 1 ? vec3(-1.4, 0.0, -1.0) : vec3(-1.4, 0.0, -1.2);
    vec3 hi = objects == 1 ? vec3(1.0, 0.75, 0.7) : vec3(1.5, 1.7, 1.1);
    vec3 a = (lo - ro) * inverse, b = (hi - ro) * inverse, n = min(a, b), f = max(a, b);
    return vec2(max(maxComponent(n), 0.0), min(f.x, min(f.y, f.z)));
}
vec3 objectNormal(vec3 p) {
    vec2 e = vec2(1.0, -1.0) * 0.0015;
    vec3 n = e.xyy * map(p + e.xyy).x + e.yyx * map(p + e.yyx).x
        + e.yxy * map(p + e.yxy).x + e.xxx * map(p + e.xxx).x;
    return n * inversesqrt(max(dot(n, n), 1e-20));
}
float intersectObjects(vec3 ro, vec3 rd, float pixel) {
    vec2 span = objectSpan(ro, rd);
    for (int i = 0; i < 64 && span.x < span.y; ++i) {
        float d = map(ro + span.x * rd).x;
        if (d < 0.4 * pixel * span.x + 1e-4) return span.x;
        span.x += d;
    }
    return kFar;
}
// Part of the sun that is seen past the objects; the surface bends its light by `blur` rad.
float sunSeen(vec3 p, vec3 towards, float blur) {
    vec2 span = objectSpan(p, towards);
    float seen = 1.0;
    span.x = max(span.x, 0.01);
    for (int i = 0; i < 24 && span.x < span.y && seen > 0.0; ++i) {
        float d = map(p + span.x * towards).x;
        seen = min(seen, 0.5 + 0.5 * d / (blur * span.x));
        span.x += clamp(d, 0.02, 0.25);
    }
    seen = max(seen, 0.0);
    return seen * seen * (3.0 - 2.0 * seen);
}

// ---- Shading ------------------------------------------------------------------------------------
struct Medium { vec3 absorption, extinction, diffuse; vec3 towards; vec3 sun; };

Medium waterMedium() {
    Medium m;
    m.absorption = -log(clamp(linearColour(waterTint), 1e-3, 0.999)) / tintDistance;
    m.extinction = m.absorption + haze;
    m.diffuse = 1.2 * m.absorption + 0.3 * haze;     // of light from all sides
    mat2 unused;
    vec2 aside = bend(vec2(0.0), kIorWater.y, unused);
    m.towards = normalize(vec3(-aside.x, 1.0, -aside.y));
    vec3 sun = towardsSun();
    float low = exp(-0.12 / sun.y);                   // reddened near the horizon
    m.sun = sunPower * vec3(1.0, mix(0.75, 0.96, low), mix(0.45, 0.90, low))
        * (1.0 - fresnel(sun.y, kIorWater.y)) * sun.y / m.towards.y;
    return m;
}

// Coverage of a pixel of width w, centred at x, by lines of half-width h at every integer.
float lines(float x, float h, float w) {
    w = max(w, 1e-4);
    float a = x - 0.5 * w, b = x + 0.5 * w;
    vec2 whole = floor(vec2(a, b) + 0.5), part = clamp(vec2(a, b) - whole, -h, h);
    return clamp((2.0 * h * (whole.y - whole.x) + part.y - part.x) / w, 0.0, 1.0);
}

// Light at a point relative to flat water; w: footprint, m.
vec3 causticAt(vec3 p, Medium m, float w) {
    float below = max(depth - p.y, 0.0), fall = below / depth;
    vec2 u = (p.xz + m.towards.xz / m.towards.y * below) / kTile;
    float lod = log2(max(w / kTile * float(kMap), 1e-3));
    vec3 bed = textureLod(caustics, u, lod).rgb;
    if (lod < 0.0) {   // magnified: a quadratic B-spline in place of the bilinear filter
        vec2 e = vec2(0.25, -0.25) / float(kMap) * 1.6;
        bed = 0.25 * (textureLod(caustics, u + e.xx, 0.0).rgb + textureLod(caustics, u + e.yy, 0.0).rgb
            + textureLod(caustics, u + e.xy, 0.0).rgb + textureLod(caustics, u + e.yx, 0.0).rgb);
    }
    if (fall > 0.999) return bed;
    vec4 levels = textureLod(slices, u, lod - 1.0);
    float light = 1.0 + dot(max(1.0 - abs(4.0 * fall - vec4(1, 2, 3, 4)), 0.0), levels - 1.0);
    return max(light + (bed - levels.w) * square(square(fall)), 0.0);
}

vec3 skyColour(vec3 rd, float rough) {
    vec3 sun = towardsSun();
    float up = sqrt(clamp(rd.y, 0.0, 1.0)), away = max(1.0 - dot(rd, sun), 0.0);
    vec3 sky = skyLight * mix(vec3(0.95, 1.1, 1.25), vec3(0.28, 0.58, 1.15), up);
    float width = 0.0015 + rough;
    vec3 tone = vec3(1.0, 0.94, 0.84) * sunPower;
    return sky + tone * (0.25 * exp(-away / width) / width / (2.0 * kPi) + 0.15 * exp(-8.0 * away));
}

// Light scattered into a ray of length t: exact for flat water, the pattern by few jittered steps.
vec3 inscatter(vec3 ro, vec3 rd, float t, Medium m, float jitter) {
    float below = max(depth - ro.y, 0.0), g = 0.72, cosine = dot(rd, m.towards);
    float phase = (1.0 - g * g) / (4.0 * kPi * pow(1.0 + g * g - 2.0 * g * cosine, 1.5)) + 0.02;
    vec3 fade = m.extinction - m.extinction * rd.y / m.towards.y;    // along the ray, with its sun
    vec3 glow = m.extinction - m.diffuse * rd.y;
    vec3 start = haze * phase * m.sun * exp(-m.extinction * below / m.towards.y);
    vec3 all = vec3(fogIntegral(fade.x * t), fogIntegral(fade.y * t), fogIntegral(fade.z * t));
    vec3 soft = vec3(fogIntegral(glow.x * t), fogIntegral(glow.y * t), fogIntegral(glow.z * t));
    vec3 sum = start * all * t
        + haze * 0.45 * (skyLight * vec3(0.7, 0.95, 1.1) + 0.25 * m.sun) * exp(-m.diffuse * below) * soft * t;
    if (shafts > 0.0 && haze > 0.0) {
        float end = min(t, 4.0 / min(m.extinction.x, min(m.extinction.y, m.extinction.z)));
        float size = end / float(shaftSamples);
        vec3 weight = start * size
            * vec3(fogIntegral(fade.x * size), fogIntegral(fade.y * size), fogIntegral(fade.z * size));
        vec3 step = exp(-fade * size);
        vec2 u = (ro.xz + m.towards.xz / m.towards.y * below) / kTile;
        vec2 du = (rd.xz - m.towards.xz / m.towards.y * rd.y) / kTile;
        float lod = max(log2(max(size * length(du) * float(kSliceMap), 1e-3)) - 2.0, 0.0);
        vec3 extra = vec3(0.0);
        for (int i = 0; i < shaftSamples; ++i) {
            float s = (float(i) + jitter) * size, fall = clamp((below - rd.y * s) / depth, 0.0, 1.0);
            vec4 levels = textureLod(slices, u + s * du, lod);
            extra += weight * dot(max(1.0 - abs(4.0 * fall - vec4(1, 2, 3, 4)), 0.0), levels - 1.0);
            weight *= step;
        }
        sum = max(sum + shafts * extra, 0.0);
    }
    return sum;
}

// Albedo and normal of sand or of a tiled face; w: the pixel's footprint along and across, m.
vec3 sandColour(vec3 p, float w, out vec3 nor) {
    float lod = log2(max(w / kSandTile * 512.0, 1.0));
    vec4 near = textureLod(sand, p.xz / kSandTile, lod);
    vec4 far = textureLod(sand, turn(p.xz, 0.6) / (3.7 * kSandTile), max(lod - 1.9, 0.0));
    nor = normalize(vec3(-near.x, 1.0, -near.y));
    return mix(vec3(0.50, 0.40, 0.27), vec3(0.80, 0.70, 0.53), near.z) * (0.8 + 0.4 * far.z);
}
vec3 tileColour(vec3 p, vec3 nor, vec2 w) {
    vec2 uv = (abs(nor.y) > 0.5 ? p.xz : abs(nor.x) > 0.5 ? p.zy : p.xy) / 0.15;
    w /= 0.15;
    vec3 r = random3(ivec3(ivec2(floor(uv)), 3));
    float apart = clamp(1.5 - max(w.x, w.y), 0.0, 1.0);
    vec3 tile = mix(vec3(0.36, 0.60, 0.66), vec3(0.60, 0.74, 0.76), mix(0.5, r.x, apart));
    if (abs(nor.y) > 0.5) {
        float lane = 1.0 - smoothstep(0.30 - 0.1 * w.x, 0.31 + 0.1 * w.x, abs(abs(p.x) - 2.1) + 0.15);
        tile = mix(tile, vec3(0.02, 0.10, 0.24), lane);
    }
    float joint = max(lines(uv.x, 0.03, w.x), lines(uv.y, 0.03, w.y));
    return mix(tile, vec3(0.72, 0.76, 0.74), joint);
}
vec3 objectColour(float id, vec3 p, vec3 nor) {
    if (id < 1.5) {
        vec3 q = p - vec3(0.62, 0.27, -0.25);
        q.xy = turn(q.xy, 0.5);
        float slice = floor((atan(q.x, q.z + 1e-6) / kPi + 1.0) * 3.0);
        vec3 tone = mod(slice, 3.0) < 0.5 ? vec3(0.75, 0.06, 0.04) : mod(slice, 3.0) < 1.5
            ? vec3(0.85, 0.82, 0.75) : vec3(0.85, 0.50, 0.03);
        return tone;
    }
    if (id < 2.5) return vec3(0.85, 0.14, 0.03);
    if (id < 3.5) return vec3(0.85, 0.62, 0.05);
    if (id < 4.5) return vec3(0.62, 0.58, 0.50);
    return vec3(0.75, 0.20, 0.06);
}

// Light from a matt face to the eye.
vec3 mattLight(vec3 p, vec3 nor, vec3 albedo, float w, Medium m) {
    float below = max(depth - p.y, 0.0);
    float blur = 0.03 + 0.3 * waveSlope;
    float seen = sunSeen(p, m.towards, blur), facing = max(dot(nor, m.towards), 0.0);
    if (ground == 1) {   // the rim of the pool
        vec2 entry = abs(p.xz + m.towards.xz / m.towards.y * below) - kPool;
        seen *= 1.0 - smoothstep(-blur * below - 0.01, blur * below + 0.01, max(entry.x, entry.y));
    }
    float open = objects == 0 ? 1.0 : clamp(0.35 + map(p + 0.25 * nor).x / 0.25 * 0.65, 0.0, 1.0);
    vec3 sum = m.sun * exp(-m.extinction * below / m.towards.y) * facing * seen * causticAt(p, m, w);
    sum += open * exp(-m.diffuse * below) * (0.5 + 0.4 * nor.y)
        * (skyLight * vec3(0.75, 0.95, 1.1) + 0.12 * m.sun);
    return albedo / kPi * sum;
}

vec3 radiance(vec3 ro, vec3 rd, float pixel, float jitter) {
    Medium m = waterMedium();
    vec3 sum = vec3(0.0), throughput = vec3(1.0);
    float width = 0.0;
    for (int ray = 0; ray < 2; ++ray) {
        float t = min(rd.y > 0.0 ? (depth - ro.y) / max(rd.y, 1e-4) : ro.y / max(-rd.y, 1e-4), 200.0);
        vec3 nor = vec3(0.0, 1.0, 0.0);
        bool wall = false;
        if (ground == 1) {
            vec2 far = (mix(-kPool, kPool, greaterThan(rd.xz, vec2(0.0))) - ro.xz)
                / mix(rd.xz, vec2(1e-9), lessThan(abs(rd.xz), vec2(1e-9)));
            float side = max(min(far.x, far.y), 0.0);
            if (side < t) {
                t = side;
                wall = true;
                nor = far.x < far.y ? vec3(-sign(rd.x), 0, 0) : vec3(0, 0, -sign(rd.z));
            }
        }
        float object = intersectObjects(ro, rd, pixel);
        bool hit = object < t;
        t = min(t, object);
        sum += throughput * inscatter(ro, rd, t, m, jitter);
        throughput *= exp(-m.extinction * t);
        vec3 p = ro + t * rd;
        float w = width + pixel * t;
        if (hit || wall || rd.y < 0.0) {
            float grazing = max(abs(dot(rd, nor)), 0.02);
            vec3 albedo;
            if (hit) {
                nor = objectNormal(p);
                albedo = objectColour(map(p).y, p, nor);
            } else if (ground == 1) {
                albedo = tileColour(p, nor, vec2(w, w / grazing));
            } else {
                albedo = sandColour(p, w * inversesqrt(grazing), nor);
            }
            sum += throughput * mattLight(p, nor, albedo, w * inversesqrt(hit ? 1.0 : grazing), m);
            break;
        }
        // The surface from below.
        float lod = log2(max(w * inversesqrt(max(rd.y, 0.02)) / kTile * 256.0, 1.0));
        vec4 wave = textureLod(surface, p.xz / kTile, lod);
        p += rd * (wave.x / max(rd.y, 0.15));
        wave = textureLod(surface, p.xz / kTile, lod);
        vec3 up = normalize(vec3(-wave.y, 1.0, -wave.z));
        float cosine = clamp(dot(rd, up), 0.02, 1.0), rough = max(wave.w - dot(wave.yz, wave.yz), 0.0);
        float mirror = fresnel(cosine, 1.0 / kIorWater.y);
        vec3 through = refract(rd, -up, kIorWater.y);
        sum += throughput * (1.0 - mirror) * skyColour(through, rough);
        throughput *= mirror;
        if (mirror < 0.01) break;
        rd = reflect(rd, up);
        rd.y = min(rd.y, -0.03);
        rd = normalize(rd);
        ro = vec3(p.x, depth - 1e-3, p.z);
        width = w;
    }
    return sum;
}

// ---- Passes -------------------------------------------------------------------------------------
// Whole waves in the tile along x and z, root of the mean square of the slope times root 2, Hz.
vec4 waveShape(int i) {
    float octave = mix(-1.0, 1.4, float(i) / float(kWaves - 1));
    float angle = radians(windAngle) + kPi * spread * (2.0 * fract(kGolden * float(i) + 0.13) - 1.0);
    vec2 n = floor(kTile / waveLength * exp2(octave) * vec2(cos(angle), sin(angle)) + 0.5);
    if (n == vec2(0.0)) n = vec2(1.0, 0.0);
    float number = 2.0 * kPi / kTile * length(n);
    return vec4(n, exp(-0.5 * square(octave / 0.9)), sqrt(kGravity * number) / (2.0 * kPi));
}
void mainWaves(out vec4 colour, in vec2 pixel) {
    int i = int(pixel.x);
    float sum = 0.0;
    for (int j = 0; j < kWaves; ++j) sum += square(waveShape(j).z);
    colour = waveShape(i);
    colour.z *= i < kWaves ? waveSlope * sqrt(2.0 / sum) : 0.0;
}

float tiledNoise(vec2 unit, ivec2 period, int seed) {   // value noise on a torus
    vec2 p = unit * vec2(period), f = fract(p), s = f * f * (3.0 - 2.0 * f);
    ivec2 a = ivec2(p) % period, b = (a + 1) % period;   // unit in [0, 1)
    return mix(mix(random3(ivec3(a, seed)).x, random3(ivec3(b.x, a.y, seed)).x, s.x),
               mix(random3(ivec3(a.x, b.y, seed)).x, random3(ivec3(b, seed)).x, s.x), s.y);
}
float sandHeight(vec2 u) {   // m, on a torus
    u = fract(u);
    float bend = tiledNoise(u, ivec2(5, 4), 1) + 0.5 * tiledNoise(u, ivec2(11, 9), 2);
    float ripple = sin(2.0 * kPi * (4.0 * u.x + 17.0 * u.y + 1.5 * bend));
    float strength = 0.3 + 0.7 * tiledNoise(u, ivec2(4, 5), 3);
    return 0.006 * strength * (1.0 - abs(ripple)) + 0.02 * tiledNoise(u, ivec2(6, 7), 4)
        + 0.0012 * tiledNoise(u, ivec2(150, 151), 5);
}
// Slopes along x and z, tone.
void mainSand(out vec4 colour, in vec2 pixel) {
    vec2 u = pixel / 512.0, e = vec2(0.5 / 512.0, 0.0);
    float x = sandHeight(u + e.xy) - sandHeight(u - e.xy), z = sandHeight(u + e.yx) - sandHeight(u - e.yx);
    float tone = 0.5 + 0.35 * (tiledNoise(u, ivec2(256, 255), 6) - 0.5)
        + 0.4 * (tiledNoise(u, ivec2(80, 77), 7) - 0.5) + 0.4 * (tiledNoise(u, ivec2(9, 10), 8) - 0.5);
    colour = vec4(vec2(x, z) / (2.0 * e.x * kSandTile), clamp(tone, 0.0, 1.0), 1.0);
}

void mainSurface(out vec4 colour, in vec2 pixel) {
    Water water = waterAt(pixel / 256.0, true, 0);
    colour = vec4(water.height, water.slope, dot(water.slope, water.slope));
}

// How many passes of photons have been counted since the time or a tweak last changed.
void mainClock(out vec4 colour, in vec2 pixel) {
    vec4 before = texelFetch(clock, ivec2(0), 0);
    float look = depth + 3.1 * waveLength + 5.3 * waveSlope + 7.7 * spread + 0.13 * windAngle
        + 11.3 * sunElevation + 0.17 * sunAngle + 13.9 * dispersion + 17.1 * animation;
    colour = vec4(float(iTick & 0xffffu), float(iTick >> 16u), look, 1.0);
    if (before.xyz == colour.xyz) colour.w = before.w + 1.0;
}

void mainLanding(out vec4 middle, out vec4 pair, in vec2 pixel) {
    ivec2 cell = ivec2(pixel);
    vec2 start = vec2(0.0);
    if (method == kPhotons) start = photonStart(cell, photonPass());
    landAt((vec2(cell) + start) / float(meshCells()), true, 0, middle, pair);
}
void mainCells(out vec4 colour, in vec2 pixel) {
    colour = landingBox(landing, split, ivec2(pixel), ivec2(0), meshCells(), photonPass());
}
void mainBlocks(out vec4 colour, in vec2 pixel) {
    colour = boxOf(cellBoxes, ivec2(pixel) * 4, ivec2(0), 4, meshCells(), 1.0 / float(meshCells()));
}
void mainSupers(out vec4 colour, in vec2 pixel) {
    colour = boxOf(blocks, ivec2(pixel) * 4, ivec2(0), 4, meshCells() / 4, 4.0 / float(meshCells()));
}
void mainReach(out vec4 colour, in vec2 pixel) {
    colour = boxOf(supers, ivec2(0), ivec2(0), meshCells() / 16, meshCells() / 16, 0.0);
}

// The loop of the periodic method: frame k stands in column k % 4 and row k / 4 of each buffer.
void mainFrameLanding(out vec4 middle, out vec4 pair, in vec2 pixel) {
    middle = pair = vec4(0.0);
    if (method != kPeriodic) return;
    ivec2 at = ivec2(pixel), frame = at / kFrameCells;
    landAt(vec2(at % kFrameCells) / float(kFrameCells), false, frame.x + 4 * frame.y, middle, pair);
}
void mainFrameCells(out vec4 colour, in vec2 pixel) {
    ivec2 at = ivec2(pixel);
    colour = landingBox(frameLanding, frameSplit, at % kFrameCells, at / kFrameCells * kFrameCells, kFrameCells, 0);
}
void mainFrameBlocks(out vec4 colour, in vec2 pixel) {
    int side = kFrameCells / 4;
    ivec2 at = ivec2(pixel);
    colour = boxOf(frameCells, at % side * 4, at / side * kFrameCells, 4, kFrameCells, 1.0 / float(kFrameCells));
}
void mainFrameSupers(out vec4 colour, in vec2 pixel) {
    int side = kFrameCells / 16;
    ivec2 at = ivec2(pixel);
    colour = boxOf(frameBlocks, at % side * 4, at / side * (4 * side), 4, 4 * side, 4.0 / float(kFrameCells));
}
void mainFrameReach(out vec4 colour, in vec2 pixel) {
    int side = kFrameCells / 16;
    colour = boxOf(frameSupers, ivec2(0), ivec2(pixel) * side, side, side, 0.0);
}
void mainFrames(out vec4 colour, in vec2 pixel) {
    colour = vec4(1.0);
    if (method != kPeriodic) return;
    ivec2 at = ivec2(pixel), frame = at / kMap;
    colour.rgb = gather(frameLanding, frameSplit, frameCells, frameBlocks, frameSupers,
                        texelFetch(frameReach, frame, 0), frame, kFrameCells,
                        vec2(at % kMap) / float(kMap), 1.0 / float(kMap), 1.0, dispersion > 0.0);
}
// Five frames of the loop, the newest fading in while the oldest fades out.
vec3 blendFrames(ivec2 at) {
    float now = cycles(1.0 / periodicSeconds) * float(kFrames), part = fract(now);
    float weights[7] = float[7](0.0, 0.4, 0.3, 0.2, 0.1, 0.05, 0.0);
    vec3 sum = vec3(0.0);
    for (int j = 0; j < 6; ++j) {
        int k = (int(now) + 1 - j + kFrames) % kFrames;
        sum += mix(weights[j], weights[j + 1], part) * texelFetch(frames, ivec2(k & 3, k >> 2) * kMap + at, 0).rgb;
    }
    return sum / 1.05;
}

void mainCaustics(out vec4 colour, in vec2 pixel) {
    vec2 u = pixel / float(kMap), corner = (pixel - 0.5) / float(kMap);
    vec3 sun = towardsSun();
    mat2 unused;
    colour = vec4(1.0);
    if (method == kVertical) {
        vec2 slope = waterAt(u + bend(vec2(0.0), kIorWater.y, unused) * depth / kTile, true, 0).slope;
        float cosine = dot(sun, normalize(vec3(-slope.x, 1.0, -slope.y)));
        colour.rgb = vec3(pow(max(cosine / sun.y, 0.0), contrast));
    } else if (method == kSnell) {
        vec2 slope = waterAt(u, true, 0).slope;
        vec3 nor = normalize(vec3(-slope.x, 1.0, -slope.y));
        vec3 out1 = refract(waterMedium().towards, -nor, kIorWater.y);
        colour.rgb = vec3(pow(clamp(dot(out1, sun), 0.0, 1.0), contrast));
    } else if (method == kPeriodic) {
        colour.rgb = blendFrames(ivec2(pixel));
    } else if (method == kArea && isCalm()) {
        colour.rgb = vec3(inverseLight(u, 1.0));
    } else {
        colour.rgb = gather(landing, split, cellBoxes, blocks, supers, texelFetch(reach, ivec2(0), 0),
                            ivec2(0), meshCells(), corner, 1.0 / float(kMap), 1.0, dispersion > 0.0);
        if (method == kPhotons)
            colour.rgb = mix(previousFrame(texelFetch(caustics, ivec2(pixel), 0)).rgb, colour.rgb,
                             1.0 / float(photonPass()));
    }
}

// The same at four levels of the water, without colours.
void mainSlices(out vec4 colour, in vec2 pixel) {
    vec2 u = pixel / float(kSliceMap), corner = (pixel - 0.5) / float(kSliceMap);
    if (method < kArea) {   // these know the floor only: its pattern fades towards the surface
        colour = mix(vec4(1.0), vec4(textureLod(caustics, u, 1.0).g), kFalls);
        return;
    }
    for (int i = 0; i < 4; ++i) {
        if (method == kArea && isCalm()) colour[i] = inverseLight(u, kFalls[i]);
        else colour[i] = gather(landing, split, cellBoxes, blocks, supers, texelFetch(reach, ivec2(0), 0),
                                ivec2(0), meshCells(), corner, 1.0 / float(kSliceMap), kFalls[i], false).y;
    }
    if (method == kPhotons)
        colour = mix(previousFrame(texelFetch(slices, ivec2(pixel), 0)), colour, 1.0 / float(photonPass()));
}

// ---- Image --------------------------------------------------------------------------------------
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
    bool dragged = iMouse.xy != vec2(0.0);   // the middle of the picture is the camera's own place
    vec2 orbit = dragged ? iMouse.xy / iResolution.xy - 0.5 : vec2(0.0);
    float angle = radians(cameraAngle) - 2.0 * kPi * orbit.x;
    float height = clamp(cameraHeight - 4.0 * orbit.y, 0.05, depth - 0.1);
    vec3 right = vec3(cos(angle), 0.0, -sin(angle)), back = vec3(sin(angle), 0.0, cos(angle));
    vec3 ro = cameraDistance * back + targetShift * right;
    if (ground == 1) ro.xz = clamp(ro.xz, 0.1 - kPool, kPool - 0.1);
    ro.y = height;
    vec2 aim = vec2(max(cameraDistance, 1e-3), targetHeight - height);   // ahead, up
    aim *= inversesqrt(dot(aim, aim));
    vec3 forward = vec3(0.0, aim.y, 0.0) - aim.x * back, up = cross(right, forward);
    vec2 uv = (fragCoord - 0.5 * iResolution.xy) / iResolution.y;
    float lens = focalLength / 24.0;
    vec3 rd = normalize(uv.x * right + uv.y * up + lens * forward);
    float falloff = square(dot(rd, forward));   // half of a simple lens's cos^4
    float jitter = random3(ivec3(ivec2(fragCoord * 16.0), 5)).x;
    vec3 light = radiance(ro, rd, 1.0 / (lens * iResolution.y), jitter);
    fragColor = vec4(display(exp2(exposure) * falloff * light), 1.0);
}
