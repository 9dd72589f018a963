// Caustics: light on the floor of a pool.
//
// Sunlight through a moving surface draws dancing filaments on sand or tiles, on what stands there,
// and as shafts in the blue-green water. Five methods find them on the same water, floor and light,
// from the classic shortcut to photons that are gathered without bound.
//
// Method   A map holds, for each texel of the floor, the light that falls into it relative to flat
//          water. Nothing can be drawn forward here, so forward methods are turned round: a pass
//          keeps where the light of each surface cell lands, four levels of boxes over the cells
//          find those that reach four by four texels, then one, and the exact overlap of triangle
//          and texel shares a triangle's light (area), or a photon counts where it lands (photons:
//          one a cell and frame, at a new place in it, so the mean over frames is exact in
//          expectation). Neither can lose light. Calm water needs one inverse search and 1/|J|
//          instead. The same at two levels between gives the light on objects and in the water.
// Sources  Stam, Random caustics, SIGGRAPH (1996): periodic tiles. Guardado and Sanchez-Crespo, GPU
//          Gems ch. 2 (2004): the shortcuts. Born and Wolf, Principles of Optics, 1.5: Fresnel.
//          Daimon and Masumura, Appl. Opt. 46 (2007): water's indices. Roberts (2018): R2 sequence.
//          Jarzynski and Olano, JCGT 9(3) (2020): pcg3d. Henyey and Greenstein, ApJ 93 (1941).
// Units    1 unit = 1 m, y up, linear sRGB colour until the display curve; the floor is y = 0.
// Passes   sand, waves: on change of a tweak. surface, landing to tiles, caustics, slices: every
//          frame. clock: photons. frame...: the loop of `periodic`, on change of a tweak.
// Bounds   A tile visits at most 96 x 96 of the largest boxes, a texel all of a tile's quads:
//          44,000 at the ends of all ranges, under the 65,535 turns of llvmpipe.
// Defaults From `glint study presets/caustics.toml`, RMSE to 257 frames of photons: area 0.0016,
//          one frame of photons 0.016 in nearly the same time; snell 0.064, periodic 0.075 and
//          vertical 0.13 in a third of it. 16 shaftSamples are nearer than 1 to 8, for a twentieth
//          more.
// Licence  MIT

// ---- Tweaks -------------------------------------------------------------------------------------
//@ group Water
uniform float depth;           //@ 2.4 [0.5, 6] unit=m "of the water"
uniform float waveLength;      //@ 0.9 [0.3, 2.5] log unit=m "of the strongest waves"
uniform float waveSlope;       //@ 0.09 [0, 0.3] "root mean square; 0 is a mirror"
uniform float spread;          //@ 1.0 [0, 1] "of the waves' directions: 0 one way, 1 all round"
uniform float windAngle;       //@ 25 [-180, 180] unit=deg "where the waves go"
uniform float animation;       //@ 1.0 [0, 4] "speed of everything that moves"
uniform vec3  waterTint;       //@ #6ecbe0 "what white light becomes over the distance below"
uniform float tintDistance;    //@ 6.0 [0.5, 50] log unit=m "that light goes to take on the tint"
uniform float haze;            //@ 0.08 [0, 0.5] unit=1/m "light scattered out of its way"
//@ group Light
uniform int method; //@ 3 {vertical, snell, periodic, area, photons} quality reference=4 second=area "of light"
uniform int   folds;           //@ 0 {automatic, never, always} "area: 1/|J| where none, or a mesh"
uniform float sunElevation;    //@ 55 [15, 90] unit=deg "above the horizon"
uniform float sunAngle;        //@ 30 [-180, 180] unit=deg "round the axis; 0 is ahead"
uniform float sunPower;        //@ 6.0 [0, 20] "irradiance of a face towards the sun"
uniform float skyLight;        //@ 1.0 [0, 4] "of the open sky"
uniform float dispersion;      //@ 1.0 [0, 8] "spread of the colours; 1 is true"
uniform float shafts;          //@ 1.0 [0, 4] "contrast of the light in the water"
uniform float contrast;        //@ 24 [1, 256] log "vertical, snell: exponent of that style"
uniform float loopSeconds;     //@ 2.0 [0.5, 8] unit=s "periodic: length of the loop"
//@ group Floor
uniform int   ground;          //@ 0 {sand, tiles} "what lies below; tiles have walls"
uniform int   objects;         //@ 2 {none, toys, ruin} "what stands on it"
//@ group Camera
uniform float cameraDistance;  //@ 3.4 [0, 8] unit=m "from the axis"
uniform float cameraAngle;     //@ 0 [-180, 180] unit=deg "round the axis"
uniform float cameraHeight;    //@ 0.5 [0.05, 5.9] unit=m "of the eye"
uniform float targetHeight;    //@ 0.9 [0, 6] unit=m "of the point looked at"
uniform float targetShift;     //@ 0.0 [-4, 4] unit=m "eye and point to the right"
uniform float focalLength;     //@ 22 [12, 120] log unit=mm "of a lens on 36 x 24 mm film"
uniform float exposure;        //@ 0.0 [-4, 4] unit=stop "before the display curve"
//@ group Quality
uniform int   cells;           //@ 192 [64, 256] log quality reference=256 second=192 "of the mesh, a side"
uniform int   shaftSamples;    //@ 16 [1, 256] log quality reference=256 "along one view ray"

precision highp sampler2D;     // the default is lowp: Mesa then reads 32-bit buffers as halves
uniform sampler2D sand;          //@ pass mainSand size=512x512 wrap=repeat filter=mipmap
uniform sampler2D waves;         //@ pass mainWaves size=16x1 filter=nearest
uniform sampler2D surface;       //@ pass mainSurface size=128x128 wrap=repeat filter=mipmap
uniform sampler2D clock;         //@ pass mainClock size=1x1
uniform sampler2D landing;       //@ pass mainLanding size=256x256 filter=nearest
uniform sampler2D split;         //@ pass mainLanding size=256x256 filter=nearest
uniform sampler2D cellBoxes;     //@ pass mainCells size=256x256 filter=nearest
uniform sampler2D quadBoxes;     //@ pass mainQuads size=128x128 filter=nearest
uniform sampler2D blocks;        //@ pass mainBlocks size=64x64 filter=nearest
uniform sampler2D supers;        //@ pass mainSupers size=16x16 filter=nearest
uniform sampler2D reach;         //@ pass mainReach size=1x1
uniform sampler2D tiles;         //@ pass mainTiles size=96x96 filter=nearest
uniform sampler2D frameLanding;  //@ pass mainFrameLanding size=512x512 filter=nearest
uniform sampler2D frameSplit;    //@ pass mainFrameLanding size=512x512 filter=nearest
uniform sampler2D frameCells;    //@ pass mainFrameCells size=512x512 filter=nearest
uniform sampler2D frameQuads;    //@ pass mainFrameQuads size=256x256 filter=nearest
uniform sampler2D frameBlocks;   //@ pass mainFrameBlocks size=128x128 filter=nearest
uniform sampler2D frameSupers;   //@ pass mainFrameSupers size=32x32 filter=nearest
uniform sampler2D frameReach;    //@ pass mainFrameReach size=4x4
uniform sampler2D frameTiles;    //@ pass mainFrameTiles size=256x256 filter=nearest
uniform sampler2D frames;        //@ pass mainFrames size=1024x1024
uniform sampler2D caustics;      //@ pass mainCaustics size=256x256 wrap=repeat filter=mipmap
uniform sampler2D slices;        //@ pass mainSlices size=128x128 wrap=repeat filter=mipmap

// ---- Constants and numbers ----------------------------------------------------------------------
// The water repeats after a square of kTile, and so does all that follows from it: coordinates in
// it are u, from 0 to 1 a tile.

const float kPi = 3.14159265358979;
const float kGolden = 0.61803398874989;
const float kTile = 4.5;                   // m, side of the square after which the water repeats
const int   kWaves = 12;
const float kGravity = 9.81;               // m/s^2
const vec3  kIorWater = vec3(1.3317, 1.3345, 1.3384);   // at 630, 546 and 465 nm, 20 C
const int   kVertical = 0, kSnell = 1, kPeriodic = 2, kArea = 3, kPhotons = 4;
const int   kMap = 256, kSliceMap = 128;   // texels a side: of the floor, of a level above it
const int   kPhotonCells = 256, kFrameCells = 128, kFrames = 16;   // cells a side
const int   kShadeSteps = 32;              // towards the sun, over the waves
const int   kRootSteps = 2;                // of 1/|J|, to 1e-4 of the light where water is calm
const vec2  kLevels = vec2(0.35, 0.7);     // parts of the depth
const float kFar = 1e9;                    // m, a miss
const float kSandTile = 2.25;              // m
const vec2  kPool = vec2(4.2, 7.5);        // m, half width and half length, with tiles
const float kColumnGap = 2.2;              // m, from one of a row to the next

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

// A number from 0 to 1 for each pixel, nearly evenly apart among those of every square of 2, 4, 8
// ... pixels: quarters of quarters in an order by chance (Ahmed and Wonka, ACM TOG 39(6), 2020).
// What it leaves of an error is the finest grain, and no net as of a lattice.
float shuffledQuarters(ivec2 p) {
    float sum = 0.0, part = 0.25;
    for (int k = loopStart(); k < 6; ++k) {
        uvec3 r = hash3(ivec3(p >> 1, 60 + k)) >> 8u;   // one of the 24 orders of four
        int a = p.x & 1, b = p.y & 1, kind = int(r.x % 3u);
        int high = kind == 0 ? a : kind == 1 ? b : a ^ b, low = kind == 0 ? b : a;
        if ((r.y & 1u) == 1u) low ^= high;
        sum += part * float((2 * high + low) ^ int(r.z & 3u));
        part *= 0.25;
        p >>= 1;
    }
    return sum;
}

vec2 turn(vec2 p, float angle) {
    float c = cos(angle), s = sin(angle);
    return vec2(c * p.x + s * p.y, c * p.y - s * p.x);
}
float maxComponent(vec3 v) { return max(v.x, max(v.y, v.z)); }
float square(float x) { return x * x; }
vec3 linearColour(vec3 c) {   // from sRGB, a fit to 1/500
    return c * (c * (c * 0.305306011 + 0.682171111) + 0.012522878);
}
vec4 previousFrame(vec4 p) {   // NaN compares false
    return mix(vec4(0.0), p, lessThanEqual(abs(p), vec4(6e4)));
}
int lowestBit(int mask) { return (floatBitsToInt(float(mask & -mask)) >> 23) - 127; }
vec3 meanFade(vec3 x) {   // (1 - exp(-x)) / x, the mean of exp over a step
    vec3 series = 1.0 - x * 0.5 * (1.0 - x / 3.0 * (1.0 - x * 0.25));
    vec3 safe = mix(x, vec3(1.0), lessThan(abs(x), vec3(0.02)));
    return mix((1.0 - exp(-clamp(safe, -80.0, 80.0))) / safe, series,
               vec3(lessThan(abs(x), vec3(0.02))));
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
// A sum of sines h(p) = sum a sin(k.p - w t) with whole waves in the tile and w^2 = g |k|. Where it
// slopes by s, Snell's law sends sunlight bend(s) metres aside for each metre down: light that
// enters at p lands at L(p) = p + (depth + h) bend(s). What the floor sees is how L squeezes areas:
// a patch of water that lands on a tenth of its area is ten times as bright there, 1 / |J| with J =
// dL/dp. Where several patches land on one place their light adds, and where J = 0 there is a
// bright line.

struct Water { float height; vec2 slope; vec3 curve; };   // m; 1; xx, xz and zz, 1/m

// The water over a point of the tile, in tiles; now, or in a frame of the loop.
Water waterAt(vec2 u, bool now, int frame) {
    Water water = Water(0.0, vec2(0.0), vec3(0.0));
    int count = int(fetch(waves, vec2(kWaves, 0), vec2(16.0, 1.0)).z);   // a loop that drivers leave one
    for (int i = 0; i < count; ++i) {
        vec4 wave = fetch(waves, vec2(i, 0), vec2(16.0, 1.0));   // whole waves in the tile, slope, Hz
        float turns = now ? cycles(wave.w)
            : fract(max(floor(wave.w * loopSeconds + 0.5), 1.0) * float(frame) / float(kFrames));
        float phase = fract(dot(wave.xy, u) - turns) + fract(kGolden * float(i * i));
        vec2 k = 2.0 * kPi / kTile * wave.xy;            // 1/m
        float amplitude = wave.z / max(length(k), 1e-6);
        float s = amplitude * sin(2.0 * kPi * phase), c = amplitude * cos(2.0 * kPi * phase);
        water.height += s;
        water.slope += c * k;
        water.curve -= s * vec3(k.x * k.x, k.x * k.y, k.y * k.y);
    }
    return water;
}

vec3 sunAbove() {   // unit vector towards it
    float e = radians(min(sunElevation, 89.99)), a = radians(sunAngle);
    return vec3(sin(a) * cos(e), sin(e), -cos(a) * cos(e));
}

// Snell's law for the sun: metres aside per metre of depth under a slope, and its derivative. With
// a normal (-slope.x, 1, -slope.y) of any length the ray is eta * incident - along * normal.
vec2 bend(vec2 slope, float ior, out mat2 derivative) {
    vec3 i = -sunAbove();
    float eta = 1.0 / ior, k = (1.0 - eta) * (1.0 + eta);
    float m = i.y - dot(i.xz, slope), q = 1.0 + dot(slope, slope);
    float root = sqrt(q * k + eta * eta * m * m);
    float along = (eta * m + root) / q;
    vec2 across = eta * i.xz + along * slope;
    float down = max(along - eta * i.y, 0.1);            // a slope of 1 leaves 0.2
    vec2 growth =
        ((k * slope - eta * eta * m * i.xz) / root - eta * i.xz - 2.0 * along * slope) / q;
    derivative = (mat2(along) + outerProduct(slope, growth)) / down
        - outerProduct(across, growth) / (down * down);
    return across / down;
}
vec2 bend(vec2 slope, float ior) {
    mat2 unused;
    return bend(slope, ior, unused);
}
vec2 levelBend() { return bend(vec2(0.0), kIorWater.y); }

// Light that passes a level square metre of surface, relative to flat water.
float fluxThrough(vec2 slope) {
    vec3 sun = sunAbove();
    float facing = max(sun.y - dot(sun.xz, slope), 0.0);
    float cosine = min(facing * inversesqrt(1.0 + dot(slope, slope)), 1.0);
    return facing / sun.y * (1.0 - fresnel(cosine, kIorWater.y))
        / (1.0 - fresnel(sun.y, kIorWater.y));
}

// 1 where the surface at u sees the sun, 0 where a wave stands before it: a walk to where the ray
// is above the highest crest, for waves that are steeper than the sun is high.
float besideWaves(vec2 u, float height, bool now, int frame) {
    vec3 sun = sunAbove();
    vec2 most = fetch(waves, vec2(kWaves, 0), vec2(16.0, 1.0)).xy;   // slope and height that no wave passes
    float away = length(sun.xz), rise = sun.y / away, range = (most.y - height) / rise, seen = 1.0;
    for (int k = 0; k < (most.x > rise ? kShadeSteps : 0) && seen > 0.0; ++k) {
        float s = range * (float(k) + 0.5) / float(kShadeSteps);   // m, level
        vec2 at = u + s / (away * kTile) * sun.xz;
        float wave = now ? textureLod(surface, at, 0.0).x : waterAt(at, now, frame).height;
        if (wave > height + s * rise) seen = 0.0;
    }
    return seen;
}

// Where light that enters at u lands, in tiles from where flat water would send it, and its flux.
// pair: the same for red and blue.
void landingOf(vec2 u, bool now, int frame, out vec4 middle, out vec4 pair) {
    Water water = waterAt(u, now, frame);
    vec3 ior = kIorWater.y + dispersion * (kIorWater - kIorWater.y);
    vec2 level = depth * levelBend();
    float fall = depth + water.height;
    middle = vec4(fall * bend(water.slope, ior.y) - level, 0.0, 0.0);
    pair = vec4(fall * bend(water.slope, ior.x), fall * bend(water.slope, ior.z)) - level.xyxy;
    middle = clamp(middle / kTile, -2.0, 2.0);
    pair = clamp(pair / kTile, -2.0, 2.0);
    middle.z = fluxThrough(water.slope) * besideWaves(u, water.height, now, frame);
}

// Calm water: light that lands at u, at a part `fall` of the depth, has one origin, found by
// fixed-point steps; it has spread over |J| times its area, J the exact derivative of the landing.
float inverseLight(vec2 u, float fall) {
    vec2 level = fall * depth * levelBend(), at = u;
    Water water = waterAt(at, true, 0);
    for (int i = 0; i < kRootSteps; ++i) {
        at = u - (bend(water.slope, kIorWater.y) * (fall * depth + water.height) - level) / kTile;
        water = waterAt(at, true, 0);
    }
    mat2 bending, curve = mat2(water.curve.xy, water.curve.yz);
    vec2 aside = bend(water.slope, kIorWater.y, bending);
    mat2 j = mat2(1.0) + (fall * depth + water.height) * bending * curve
        + outerProduct(aside, water.slope);
    return fluxThrough(water.slope) / max(abs(determinant(j)), 1e-3);
}
// Whether no light crosses before the floor: depth times curvature times (1 - 1/n) is small. That
// is 0.25 of them; with a root mean square below 0.12 J stays far from 0 everywhere.
bool isCalm() {
    float curvature = 1.7 * 2.0 * kPi / waveLength * waveSlope;   // 1/m, root mean square
    return folds == 1 || (folds == 0 && 0.25 * depth * curvature < 0.12 * sunAbove().y);
}

// ---- Gathering ----------------------------------------------------------------------------------
// L is easy, its inverse is not: who lands here? A triangle of water lands on a triangle of floor;
// each texel wants all triangles that overlap it. Every cell of water keeps a box round where its
// light lands, every 4 x 4 cells a box round those, and so on: a texel asks from the coarsest boxes
// down, and shares out each triangle's light by the exact area of overlap. So none is lost, and
// a texel stays finite where J = 0: it holds the light that falls into it, however sharp the line.

int meshCells() { return method == kPhotons ? kPhotonCells : cells / 16 * 16; }
int photonPass() {   // from 1
    return method == kPhotons ? int(1024.0 * texelFetch(clock, ivec2(0), 0).w) : 1;
}
// Where in its cell a photon starts: an R2 sequence, shifted by a hash of the cell.
vec2 photonStart(ivec2 cell, int number) {
    uvec2 shift = hash3(ivec3(cell, 7)).xy;
    uvec2 bits = shift + uint(number) * uvec2(3242174889u, 2447445414u);
    return vec2(bits >> 8u) / 16777216.0;
}

vec2 wrapped(vec2 i, float period) { return i - period * floor(i / period); }   // whole numbers
// A box, in tiles from the cell's corner, round the landings of its corners or of its photon.
vec4 landingBox(sampler2D at, sampler2D pairs, vec2 cell, vec2 origin, float count, vec2 start,
                int corners) {
    vec2 size = vec2(textureSize(at, 0));
    vec4 box = vec4(1e3, 1e3, -1e3, -1e3);
    for (int k = 0; k < corners; ++k) {
        vec2 corner = vec2(k & 1, k >> 1), place = origin + wrapped(cell + corner, count);
        vec2 home = (corner + start) / count;
        vec4 middle = fetch(at, place, size), pair = middle.xyxy;
        if (dispersion > 0.0) pair = fetch(pairs, place, size);
        box.xy = min(box.xy, home + min(middle.xy, min(pair.xy, pair.zw)));
        box.zw = max(box.zw, home + max(middle.xy, max(pair.xy, pair.zw)));
    }
    return box;
}
// A box round the boxes of side x side children, each `cell` wide.
vec4 boxOf(sampler2D children, vec2 first, int side, float cell) {
    vec2 size = vec2(textureSize(children, 0));
    vec4 box = vec4(1e3, 1e3, -1e3, -1e3);
    for (int k = 0; k < side * side; ++k) {
        vec2 child = vec2(k % side, k / side);
        vec4 part = fetch(children, first + child, size) + cell * child.xyxy;
        box = vec4(min(box.xy, part.xy), max(box.zw, part.zw));
    }
    return box;
}
// Whether light of a box of `side` tiles at `place`, as it lands below `fall` of the depth, meets a
// square; both in tiles.
bool boxMeets(vec4 box, vec2 place, float side, float fall, vec4 texel) {
    box = mix(vec4(0.0, 0.0, side, side), box, fall) + side * place.xyxy;
    return all(lessThanEqual(box.xy, texel.zw)) && all(greaterThanEqual(box.zw, texel.xy));
}
// The rectangle of quads whose light meets a square: the first one, and how many along x and z.
vec4 quadsThatMeet(sampler2D boxes1, sampler2D boxes2, sampler2D boxes3, vec4 bounds, vec2 frame,
                   float count, vec4 texel, float fall) {
    float side = 16.0 / count, blockSide = 0.25 * side;
    vec3 sizes = vec3(textureSize(boxes1, 0).x, textureSize(boxes2, 0).x, textureSize(boxes3, 0).x);
    bounds = mix(vec4(0.0, 0.0, side, side), bounds, fall);
    vec2 first = ceil((texel.xy - bounds.zw) / side), met = vec2(1e4), last = vec2(-1e4);
    vec2 span = clamp(floor((texel.zw - bounds.xy) / side) - first + 1.0, 0.0, 96.0);
    for (float y = 0.0; y < span.y; y += 1.0)
        for (float x = 0.0; x < span.x; x += 1.0) {
            vec2 super = first + vec2(x, y);
            vec2 home = wrapped(super, count / 16.0) + frame * count / 16.0;
            vec4 box = fetch(boxes3, home, vec2(sizes.z));
            int inside = boxMeets(box, super, side, fall, texel) ? 16 : 0;
            for (int k = 0; k < inside; ++k) {
                vec2 block = vec2(k & 3, k >> 2);
                box = fetch(boxes2, 4.0 * home + block, vec2(sizes.y));
                block += 4.0 * super;
                int within = boxMeets(box, block, blockSide, fall, texel) ? 4 : 0;
                for (int j = 0; j < within; ++j) {
                    vec2 quad = vec2(j & 1, j >> 1);
                    box = fetch(boxes1, 8.0 * home + 2.0 * (block - 4.0 * super) + quad, vec2(sizes.x));
                    quad += 2.0 * block;
                    if (boxMeets(box, quad, 0.5 * blockSide, fall, texel)) {
                        met = min(met, quad);
                        last = max(last, quad);
                    }
                }
            }
        }
    return vec4(met, max(last - met + 1.0, 0.0));
}

// The area of a triangle within a square is a sum over its edges, in order: each adds the area of
// the square to its right, between its ends' heights, going up, and takes it away going down. What
// no edge separates cancels, and the triangle is left (its sign tells which way round it goes).
// Integral over the height of the unit square of the part of its width right of an edge; signed.
// (Where ?: stands for the `if` here and in triangleLight, SwiftShader compiles for minutes.)
float rightOf(vec2 a, vec2 b) {
    vec2 y = clamp(vec2(a.y, b.y), 0.0, 1.0);
    float rise = b.y - a.y, lean = abs(rise) > 1e-6 ? (b.x - a.x) / rise : 0.0;
    vec2 x = a.x + (y - a.y) * lean, left = min(x, 0.0), inside = clamp(x, 0.0, 1.0);
    float run = x.y - x.x, part = left.y - left.x
        + (inside.y - inside.x) * (1.0 - 0.5 * (inside.x + inside.y));
    float width = clamp(1.0 - 0.5 * (x.x + x.y), 0.0, 1.0);
    if (abs(run) > 1e-3) width = part / run;
    return (y.y - y.x) * width;
}
float insideUnit(vec2 p) {
    return all(greaterThanEqual(p, vec2(0.0))) && all(lessThan(p, vec2(1.0))) ? 1.0 : 0.0;
}
// Part of a triangle's light in the unit square, over its area; edges: the sum of rightOf.
float triangleLight(vec2 a, vec2 b, vec2 c, float edges) {
    float area = 0.5 * determinant(mat2(b - a, c - a));
    float share = insideUnit((a + b + c) / 3.0);   // a sliver's light goes where its middle is
    if (abs(area) > 1e-3) share = -edges / area;
    return share;
}
// Light of a cell's two halves in the unit square; corners in rows, with the flux of each.
float cellLight(vec2 a, vec2 b, vec2 c, vec2 d, vec4 flux) {
    float diagonal = rightOf(b, c);
    float low = triangleLight(a, b, c, rightOf(a, b) + diagonal + rightOf(c, a));
    float high = triangleLight(d, c, b, rightOf(d, c) - diagonal + rightOf(b, d));
    return (low * (flux.x + flux.y + flux.z) + high * (flux.y + flux.z + flux.w)) / 6.0;
}

// Light of a cell of the mesh, in three colours, in the square at `spot` of so many texels.
vec3 cellColours(sampler2D at, sampler2D pairs, float size, vec2 cell, vec2 frame, float count,
                 vec2 spot, float texels, float fall, bool tinted, int number) {
    vec4 middle[4], pair[4];
    vec2 home0 = wrapped(cell, count), aside = vec2(0.0);
    vec2 home1 = home0 + 1.0 - count * step(count, home0 + 1.0);
    if (method == kPhotons) aside = texels / count * photonStart(ivec2(home0), number);
    // Of photons the first alone counts; but in a loop of a length that is not known, the arrays would
    // stand in memory instead of registers, at twice the time of a frame whose tweaks are fed.
    for (int j = 0; j < 4; ++j) {
        vec2 corner = vec2(j & 1, j >> 1), from = mix(home0, home1, corner) + count * frame;
        vec2 place = ((cell + corner) * texels - spot * count) / count + aside;   // exact
        middle[j] = fetch(at, from, vec2(size));
        pair[j] = middle[j].xyxy;
        if (tinted) pair[j] = fetch(pairs, from, vec2(size));
        middle[j].xy = place + texels * fall * middle[j].xy;
        pair[j] = place.xyxy + texels * fall * pair[j];
    }
    if (method == kPhotons)
        return middle[0].z * vec3(insideUnit(pair[0].xy), insideUnit(middle[0].xy),
                                  insideUnit(pair[0].zw));
    vec4 flux = vec4(middle[0].z, middle[1].z, middle[2].z, middle[3].z);
    vec3 light = vec3(cellLight(middle[0].xy, middle[1].xy, middle[2].xy, middle[3].xy, flux));
    if (tinted) {
        light.x = cellLight(pair[0].xy, pair[1].xy, pair[2].xy, pair[3].xy, flux);
        light.z = cellLight(pair[0].zw, pair[1].zw, pair[2].zw, pair[3].zw, flux);
    }
    return light;
}

// Light that falls into a square of the floor, or of a level at a part `fall` of the depth, beside
// flat water's; quads: the rectangle of those that may send some. Pixels that are drawn together
// take as many turns as the one with most: what meets is marked first, and whoever has a cell waits
// until all have one.
vec3 gather(sampler2D at, sampler2D pairs, sampler2D boxes0, sampler2D boxes1, vec4 quads,
            vec2 frame, float count, vec2 spot, float texels, float fall, bool tinted) {
    float size = float(textureSize(at, 0).x), quadSide = 2.0 / count;
    vec4 texel = vec4(spot, spot + 1.0) / texels;
    int number = photonPass(), area = int(quads.z * quads.w);
    vec3 sum = vec3(0.0);
    for (int next = 0; next < area;) {
        int start = next, marks = 0, met = 0;
        vec2 quad = vec2(0.0);
        for (; next < min(start + 30, area); ++next) {
            float row = floor((float(next) + 0.5) / quads.z);
            quad = quads.xy + vec2(float(next) - row * quads.z, row);
            vec4 box = fetch(boxes1, wrapped(quad, 0.5 * count) + 0.5 * count * frame, vec2(0.5 * size));
            if (boxMeets(box, quad, quadSide, fall, texel)) marks |= 1 << (next - start);
        }
        for (; (marks | met) != 0;) {
            for (; met == 0 && marks != 0; marks &= marks - 1) {
                float i = float(start + lowestBit(marks)), row = floor((i + 0.5) / quads.z);
                quad = 2.0 * (quads.xy + vec2(i - row * quads.z, row));
                for (int k = 0; k < 4; ++k) {
                    vec2 cell = quad + vec2(k & 1, k >> 1);
                    vec4 box = fetch(boxes0, wrapped(cell, count) + count * frame, vec2(size));
                    if (boxMeets(box, cell, 0.5 * quadSide, fall, texel)) met |= 1 << k;
                }
            }
            if (met == 0) break;
            int bit = lowestBit(met);
            met &= met - 1;
            sum += cellColours(at, pairs, size, quad + vec2(bit & 1, bit >> 1), frame, count, spot,
                               texels, fall, tinted, number);
        }
    }
    return sum * square(texels / count);
}
// The same from the buffers of this moment; tile: where `tiles` keeps the quads of this square.
vec3 gatherNow(vec2 place, float texels, vec2 tile, float fall, bool tinted) {
    vec4 quads = fetch(tiles, tile + floor(place / 4.0), vec2(96.0));
    return gather(landing, split, cellBoxes, quadBoxes, quads, vec2(0.0), float(meshCells()), place,
                  texels, fall, tinted);
}

// ---- Objects ------------------------------------------------------------------------------------
// Distances by formula, joined by their minimum; a ray steps by them and cannot pass through
// (Hart). The narrowest gap on the way to the sun, over the sun's blur there, is the soft shadow.

float torus(vec3 p, float r, float thick) { return length(vec2(length(p.xz) - r, p.y)) - thick; }
// A cylinder along y with rounded edges and, on its side, flutes.
float drum(vec3 p, float r, float halfHeight, bool fluted) {
    vec2 d = vec2(length(p.xz) - r, abs(p.y) - halfHeight) + 0.02;
    if (fluted) d.x += 0.03 * abs(cos(9.0 * atan(p.x, p.z + 1e-6)));
    return length(max(d, 0.0)) + min(max(d.x, d.y), 0.0) - 0.02;
}
float starfish(vec3 p) {
    p.x = abs(p.x);   // the five arms onto one, by mirrors at 36 degrees to both sides
    vec2 mirror = vec2(0.809017, -0.587785);
    p.xz -= 2.0 * max(dot(p.xz, mirror), 0.0) * mirror;
    mirror.x = -mirror.x;
    p.xz -= 2.0 * max(dot(p.xz, mirror), 0.0) * mirror;
    float along = clamp(p.z / 0.26, 0.0, 1.0);
    return 0.6 * (length(vec3(p.x, 1.7 * p.y, p.z - 0.26 * along)) - mix(0.07, 0.014, along));
}
// Distance to the nearest object, and which; fine: with the flutes, for normals.
vec2 map(vec3 p, bool fine) {
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
    } else if (objects == 2) {   // two rows of columns, some whole
        float place = clamp(floor(p.z / kColumnGap + 0.5), -3.0, 0.0);
        vec3 q = vec3(abs(p.x) - 1.5, p.y, p.z - kColumnGap * place);
        float r = fract(kGolden * (2.0 * place + step(0.0, p.x)) + 0.1);
        float whole = step(0.45, r), tall = mix(0.35 + 2.0 * r, 2.1, whole);
        float shaft = drum(q - vec3(0.0, 0.5 * tall, 0.0), 0.25 - 0.02 * q.y, 0.5 * tall, fine);
        shaft = max(shaft, mix(dot(q, vec3(0.36, 0.9, 0.25)) - 0.87 * tall, -1.0, whole));
        shaft = min(shaft, drum(q - vec3(0.0, 0.04, 0.0), 0.36, 0.08, false));
        shaft = min(shaft, drum(q - vec3(0.0, 2.14, 0.0), 0.34, 0.07, false) + 9.0 * (1.0 - whole));
        q = p - vec3(0.75, 0.21, -0.9);
        q.xz = turn(q.xz, 0.5);
        q.yz = turn(q.yz, 0.5 * kPi - 0.08);
        float fallen = drum(q, 0.25, 0.45, fine);
        d = vec2(min(min(shaft, fallen), 0.7), 4.0);   // the next column is never nearer than 0.7
        q = p - vec3(-0.35, 0.02, 0.9);
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
    vec3 lo = objects == 1 ? vec3(-1.4, 0.0, -1.0) : vec3(-1.9, 0.0, -3.0 * kColumnGap - 0.4);
    vec3 hi = objects == 1 ? vec3(1.0, 0.75, 0.7) : vec3(1.9, 2.25, 1.3);
    vec3 a = (lo - ro) * inverse, b = (hi - ro) * inverse, n = min(a, b), f = max(a, b);
    return vec2(max(maxComponent(n), 0.0), min(f.x, min(f.y, f.z)));
}
// The normal, from the corners of a tetrahedron, and which object it is: in a loop, for a driver
// compiles a copy of the map for each place that calls it.
vec3 objectNormal(vec3 p, out float id) {
    vec3 n = vec3(0.0);
    for (int k = 0; k < 5; ++k) {
        vec3 e = vec3((k + 3 >> 1) & 1, k >> 1, k & 1) * 2.0 - 1.0;
        if (k == 4) e = vec3(0.0);
        vec2 d = map(p + 0.002 * e, true);
        n += e * d.x;
        id = d.y;
    }
    return n * inversesqrt(max(dot(n, n), 1e-20));
}
float intersectObjects(vec3 ro, vec3 rd, float pixel) {
    vec2 span = objectSpan(ro, rd);
    for (int i = 0; i < 48 && span.x < span.y; ++i) {
        float d = map(ro + span.x * rd, false).x;
        if (d < 0.4 * pixel * span.x + 1e-4) return span.x;
        span.x += d;
    }
    return kFar;
}
// Part of the sun that a face sees past the objects; the surface spreads its light by `blur` rad.
// open: how little they close it in, from the room in front of it.
float sunSeen(vec3 p, vec3 nor, vec3 towards, float blur, out float open) {
    vec3 start = p + 0.004 * nor;
    vec2 span = objectSpan(start, towards);
    float seen = 1.0;
    open = 1.0;
    span.x = max(span.x, 0.01);
    for (int i = objects > 0 ? -1 : 0; i < 16 && (i < 0 || span.x < span.y && seen > 0.0); ++i) {
        float d = map(i < 0 ? p + 0.25 * nor : start + span.x * towards, false).x;
        if (i < 0) {
            open = clamp(0.3 + 2.8 * d, 0.0, 1.0);
        } else {
            seen = min(seen, 0.5 + 0.5 * d / (blur * span.x));
            span.x += clamp(d, 0.03, 0.7);
        }
    }
    seen = max(seen, 0.0);
    return seen * seen * (3.0 - 2.0 * seen);
}

// ---- Shading ------------------------------------------------------------------------------------
// Light fades in water as exp(-extinction t) (Beer), and is scattered: once from the sun, with the
// pattern of the surface in it (shafts), and many times, as a soft field. The pattern at any depth
// is read between four levels, of which the surface is even.

struct Medium { vec3 absorption, extinction, diffuse, towards, sun; };   // 1/m; unit; irradiance

Medium waterMedium() {
    Medium m;
    m.absorption = -log(clamp(linearColour(waterTint), 1e-3, 0.999)) / tintDistance;
    m.extinction = m.absorption + haze;
    m.diffuse = 1.2 * m.absorption + 0.3 * haze;     // of light from all sides
    vec2 aside = levelBend();
    m.towards = normalize(vec3(-aside.x, 1.0, -aside.y));
    vec3 sun = sunAbove();
    float low = exp(-0.12 / sun.y);                  // it reddens near the horizon
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

// Light between the levels of the slices, as a broken line from 1 at the surface.
float levelLight(vec4 levels, float fall) {
    return 1.0 + (levels.x - 1.0) * min(fall / kLevels.x, 1.0)
        + (levels.y - levels.x) * clamp((fall - kLevels.x) / (kLevels.y - kLevels.x), 0.0, 1.0)
        + (levels.z - levels.y) * clamp((fall - kLevels.y) / (1.0 - kLevels.y), 0.0, 1.0);
}
// Light at a point relative to flat water; w: footprint, m. Four taps of the bilinear filter make a
// smooth one where the map is magnified.
vec3 causticAt(vec3 p, Medium m, float w) {
    float below = clamp(depth - p.y, 0.0, depth), fall = below / depth;
    vec2 u = (p.xz + m.towards.xz / m.towards.y * below) / kTile;
    float texels = max(w / kTile * float(kMap), 1.0);
    vec2 e = vec2(0.4, -0.4) * (texels / float(kMap));
    float lod = max(log2(texels) - 0.5, 0.0);
    vec3 bed = 0.25 * (textureLod(caustics, u + e.xx, lod) + textureLod(caustics, u + e.yy, lod)
        + textureLod(caustics, u + e.xy, lod) + textureLod(caustics, u + e.yx, lod)).rgb;
    if (fall == 1.0 || (objects == 0 && ground == 0)) return bed;
    vec4 levels = textureLod(slices, u, max(lod - 1.0, 0.0));
    return max(levelLight(levels, fall) + (bed - levels.z) * square(square(fall)), 0.0);
}

vec3 skyColour(vec3 rd, float rough) {
    float up = sqrt(clamp(rd.y, 0.0, 1.0)), away = max(1.0 - dot(rd, sunAbove()), 0.0);
    float width = 0.0015 + rough;
    vec3 glare = vec3(1.0, 0.94, 0.84) * sunPower
        * (0.04 * exp(-away / width) / width + 0.10 * exp(-8.0 * away));
    return skyLight * mix(vec3(0.95, 1.1, 1.25), vec3(0.28, 0.58, 1.15), up) + glare;
}

// Light scattered into a ray of length t: exact for flat water, the pattern by few jittered steps,
// each exact in its own extinction. Biased: all but the first scattering is one soft field.
vec3 inscatter(vec3 ro, vec3 rd, float t, Medium m, float jitter) {
    float below = max(depth - ro.y, 0.0), g = 0.72, cosine = dot(rd, m.towards);
    float phase = (1.0 - g * g) / (4.0 * kPi * pow(1.0 + g * g - 2.0 * g * cosine, 1.5)) + 0.02;
    vec3 fade = m.extinction * (1.0 - rd.y / m.towards.y);   // along the ray, with its sunlight
    vec3 start = haze * phase * m.sun * exp(-m.extinction * below / m.towards.y);
    vec3 field = 0.3 * haze * (skyLight * vec3(0.6, 0.95, 1.15) + 0.2 * m.sun);
    vec3 sum = start * t * meanFade(fade * t) + field * exp(-m.diffuse * below)
        * t * meanFade((m.extinction - m.diffuse * rd.y) * t);
    if (shafts > 0.0 && haze > 0.0) {
        float least = min(m.extinction.x, min(m.extinction.y, m.extinction.z));
        float size = min(t, 4.0 / least) / float(shaftSamples);   // beyond, 1.8 % are left
        vec3 weight = start * size * meanFade(fade * size), lost = exp(-fade * size);
        vec2 lean = m.towards.xz / m.towards.y, du = (rd.xz - lean * rd.y) / kTile;
        vec2 u = (ro.xz + lean * below) / kTile;
        float lod = max(log2(max(size * length(du) * float(kSliceMap), 1e-3)) - 3.0, 0.0);
        vec3 extra = vec3(0.0);
        for (int i = 0; i < shaftSamples; ++i) {
            float s = (float(i) + jitter) * size;
            float fall = clamp((below - rd.y * s) / depth, 0.0, 1.0);
            extra += weight * (levelLight(textureLod(slices, u + s * du, lod), fall) - 1.0);
            weight *= lost;
        }
        sum = max(sum + shafts * extra, 0.0);
    }
    return sum;
}

// Albedo and normal of the sand; w: the pixel's footprint, m.
vec3 sandColour(vec3 p, float w, out vec3 nor) {
    float lod = log2(max(w / kSandTile * 512.0, 1.0));
    vec4 near = textureLod(sand, p.xz / kSandTile, lod);
    vec4 far = textureLod(sand, turn(p.xz, 0.6) / (3.7 * kSandTile), max(lod - 1.9, 0.0));
    nor = normalize(vec3(-near.x, 1.0, -near.y));
    return mix(vec3(0.50, 0.40, 0.27), vec3(0.80, 0.70, 0.53), near.z) * (0.8 + 0.4 * far.z);
}
// Albedo of a tiled face; w: the footprint along its two axes, m.
vec3 mosaicColour(vec3 p, vec3 nor, vec2 w) {
    vec2 uv = (abs(nor.y) > 0.5 ? p.xz : abs(nor.x) > 0.5 ? p.zy : p.xy) / 0.15;
    w /= 0.15;
    vec3 r = random3(ivec3(ivec2(floor(uv)), 3));
    float apart = clamp(1.5 - max(w.x, w.y), 0.0, 1.0);
    vec3 tile = mix(vec3(0.36, 0.60, 0.66), vec3(0.60, 0.74, 0.76), mix(0.5, r.x, apart));
    if (abs(nor.y) > 0.5) {
        float lane = abs(abs(p.x) - 2.1) / 0.15 - 1.0, soft = 0.5 * w.x + 0.02;
        tile = mix(tile, vec3(0.02, 0.10, 0.24), 1.0 - smoothstep(-soft, soft, lane));
    }
    float joint = max(lines(uv.x, 0.03, w.x), lines(uv.y, 0.03, w.y));
    return mix(tile, vec3(0.72, 0.76, 0.74), joint);
}
vec3 objectColour(float id, vec3 p) {
    if (id < 1.5) {   // a ball of six gores
        vec3 q = p - vec3(0.62, 0.27, -0.25);
        q.xy = turn(q.xy, 0.5);
        float gore = mod(floor((atan(q.x, q.z + 1e-6) / kPi + 1.0) * 3.0), 3.0);
        return gore < 0.5 ? vec3(0.75, 0.06, 0.04) : gore < 1.5 ? vec3(0.85, 0.82, 0.75)
            : vec3(0.85, 0.50, 0.03);
    }
    return id < 2.5 ? vec3(0.85, 0.14, 0.03) : id < 3.5 ? vec3(0.85, 0.62, 0.05)
        : id < 4.5 ? vec3(0.66, 0.61, 0.52) : vec3(0.80, 0.17, 0.04);
}

// Light from a matt face to the eye.
vec3 mattLight(vec3 p, vec3 nor, vec3 albedo, float w, Medium m) {
    float below = max(depth - p.y, 0.0), blur = 0.03 + 0.3 * waveSlope, open;
    float seen = sunSeen(p, nor, m.towards, blur, open), facing = max(dot(nor, m.towards), 0.0);
    if (ground == 1) {   // the rim of the pool
        vec2 entry = abs(p.xz + m.towards.xz / m.towards.y * below) - kPool;
        float soft = blur * below + 0.01;
        seen *= 1.0 - smoothstep(-soft, soft, max(entry.x, entry.y));
    }
    vec3 sum = m.sun * exp(-m.extinction * below / m.towards.y) * facing * seen
        * causticAt(p, m, w);
    sum += open * exp(-m.diffuse * below) * (0.5 + 0.4 * nor.y)
        * (skyLight * vec3(0.75, 0.95, 1.1) + 0.12 * m.sun);
    return albedo / kPi * sum;
}

// Where a ray from within leaves the water's box: to its floor or surface, or with tiles to a wall.
float toBounds(vec3 ro, vec3 rd, out vec3 nor, out bool wall) {
    float up = max(abs(rd.y), 1e-4);
    float t = min((rd.y > 0.0 ? max(depth - ro.y, 0.0) : ro.y) / up, 200.0);
    nor = vec3(0.0, 1.0, 0.0);
    wall = false;
    if (ground == 1) {
        vec2 along = mix(rd.xz, vec2(1e-9), lessThan(abs(rd.xz), vec2(1e-9)));
        vec2 far = (mix(-kPool, kPool, greaterThan(along, vec2(0.0))) - ro.xz) / along;
        float side = max(min(far.x, far.y), 0.0);
        wall = side < t;
        if (wall) nor = far.x < far.y ? vec3(-sign(rd.x), 0, 0) : vec3(0, 0, -sign(rd.z));
        t = min(t, side);
    }
    return t;
}
// Light from an object (hit), or else from ground or wall. A footprint w is 1 / grazing as long on
// a slanted face, so sqrt of that wide in the mean.
vec3 solidLight(vec3 p, vec3 rd, vec3 nor, bool hit, float w, Medium m) {
    float grazing = max(abs(dot(rd, nor)), 0.02);
    vec3 albedo;
    if (hit) {
        float id;
        nor = objectNormal(p, id);
        albedo = objectColour(id, p);
        grazing = 1.0;
    } else if (ground == 1) {
        albedo = mosaicColour(p, nor, min(vec2(w, w / grazing), 1.0));
    } else {
        albedo = sandColour(p, w * inversesqrt(grazing), nor);
    }
    return mattLight(p, nor, albedo, w * inversesqrt(grazing), m);
}
// The surface from below: sky through it, gives that light; p and rd become the mirrored ray's, and
// mirror its share.
vec3 throughSurface(inout vec3 p, inout vec3 rd, float w, out float mirror) {
    float texels = w * inversesqrt(max(rd.y, 0.02)) / kTile * 128.0, lod = log2(max(texels, 1.0));
    vec4 wave = textureLod(surface, p.xz / kTile, lod);
    p += rd * (wave.x / max(rd.y, 0.15));   // from the mean level to the wave, one step
    wave = textureLod(surface, p.xz / kTile, lod);
    vec3 level = normalize(vec3(-wave.y, 1.0, -wave.z));
    float cosine = clamp(dot(rd, level), 0.02, 1.0);
    // Of slopes within the footprint; below a texel what the filter makes up fades away.
    float rough = max(wave.w - dot(wave.yz, wave.yz), 0.0) * min(texels * texels, 1.0);
    mirror = fresnel(cosine, 1.0 / kIorWater.y);
    vec3 through = refract(rd, -level, kIorWater.y);
    rd = reflect(rd, level);
    rd = normalize(vec3(rd.x, min(rd.y, -0.03), rd.z));
    return skyColour(through, rough);
}

// Light that arrives at ro against rd; pixel: angle of a pixel, rad. A second ray follows what the
// surface reflects from below.
vec3 render(vec3 ro, vec3 rd, float pixel, float jitter) {
    Medium m = waterMedium();
    vec3 sum = vec3(0.0), throughput = vec3(1.0), nor;
    float width = 0.0, mirror;
    for (int ray = 0; ray < 2; ++ray) {
        bool wall;
        float t = toBounds(ro, rd, nor, wall), object = intersectObjects(ro, rd, pixel);
        bool hit = object < t;
        t = min(t, object);
        sum += throughput * inscatter(ro, rd, t, m, jitter);
        throughput *= exp(-m.extinction * t);
        vec3 p = ro + t * rd;
        float w = width + pixel * t;
        if (hit || wall || rd.y <= 0.0)
            return sum + throughput * solidLight(p, rd, nor, hit, w, m);
        vec3 above = throughSurface(p, rd, w, mirror);
        sum += throughput * (1.0 - mirror) * above;
        throughput *= mirror;
        ro = vec3(p.x, depth - 1e-3, p.z);
        if (ground == 1) ro.xz = clamp(ro.xz, 1e-3 - kPool, kPool - 1e-3);
        width = w;
    }
    return sum;
}

// ---- Passes -------------------------------------------------------------------------------------
// The forward map is turned round in steps, each a small buffer: where light lands, boxes of cells,
// boxes of boxes, which boxes reach each square of 4 x 4 texels, and at last each texel's light.
// Photons are counted by the same means, and their mean over frames is kept.

// Whole waves in the tile along x and z, slope before it is scaled, Hz. Deep water: the floor would
// slow only what is longer than twice the depth.
vec4 waveShape(int i) {
    float octave = mix(-1.0, 1.4, float(i) / float(kWaves - 1));
    float angle = radians(windAngle)
        + kPi * spread * (2.0 * fract(kGolden * float(i) + 0.13) - 1.0);
    vec2 n = floor(kTile / waveLength * exp2(octave) * vec2(cos(angle), sin(angle)) + 0.5);
    if (n == vec2(0.0)) n = vec2(1.0, 0.0);
    float number = 2.0 * kPi / kTile * length(n);
    return vec4(n, exp(-0.5 * square(octave / 0.9)), sqrt(kGravity * number) / (2.0 * kPi));
}
// The waves; after them the slope and the height, m, that all together never pass.
void mainWaves(out vec4 colour, in vec2 pixel) {
    int i = int(pixel.x);
    float sum = 0.0;
    vec2 most = vec2(0.0);
    for (int j = 0; j < kWaves; ++j) {
        vec4 wave = waveShape(j);
        sum += square(wave.z);
        most += wave.z * vec2(1.0, kTile / (2.0 * kPi * length(wave.xy)));
    }
    colour = waveShape(i);
    colour.z *= waveSlope * sqrt(2.0 / sum);
    if (i >= kWaves) colour = vec4(most * waveSlope * sqrt(2.0 / sum), float(kWaves), 0.0);
}

float tiledNoise(vec2 unit, ivec2 period, int seed) {   // value noise on a torus
    vec2 p = unit * vec2(period), f = fract(p), s = f * f * (3.0 - 2.0 * f);
    ivec2 a = ivec2(p) % period, b = (a + 1) % period;   // unit in [0, 1)
    return mix(mix(random3(ivec3(a, seed)).x, random3(ivec3(b.x, a.y, seed)).x, s.x),
               mix(random3(ivec3(a.x, b.y, seed)).x, random3(ivec3(b, seed)).x, s.x), s.y);
}
float sandHeight(vec2 u) {   // m, on a torus
    u = fract(u);
    float bent = tiledNoise(u, ivec2(5, 4), 1) + 0.5 * tiledNoise(u, ivec2(11, 9), 2);
    float ripple = abs(sin(2.0 * kPi * (3.0 * u.x + 9.0 * u.y + 1.5 * bent)));
    float strength = 0.3 + 0.7 * tiledNoise(u, ivec2(4, 5), 3);
    return 0.010 * strength * (1.0 - ripple) + 0.02 * tiledNoise(u, ivec2(6, 7), 4)
        + 0.0012 * tiledNoise(u, ivec2(150, 151), 5);
}
// Slopes along x and z, tone.
void mainSand(out vec4 colour, in vec2 pixel) {
    vec2 u = pixel / 512.0, rise = vec2(0.0);
    for (int k = 0; k < 4; ++k) {   // heights to both sides, along x and y
        float way = float(k & 1) * 2.0 - 1.0;
        vec2 aside = k < 2 ? vec2(way, 0.0) : vec2(0.0, way);
        rise += aside * sandHeight(u + aside / 1024.0);
    }
    float tone = 0.5 + 0.35 * (tiledNoise(u, ivec2(256, 255), 6) - 0.5)
        + 0.4 * (tiledNoise(u, ivec2(80, 77), 7) - 0.5)
        + 0.4 * (tiledNoise(u, ivec2(9, 10), 8) - 0.5);
    colour = vec4(rise / (kSandTile / 512.0), clamp(tone, 0.0, 1.0), 1.0);
}

void mainSurface(out vec4 colour, in vec2 pixel) {
    Water water = waterAt(pixel / 128.0, true, 0);
    colour = vec4(water.height, water.slope, dot(water.slope, water.slope));
}

// How many passes of photons have been counted since the time or a tweak last changed; small parts,
// so that the guard against what is no number leaves them alone.
void mainClock(out vec4 colour, in vec2 pixel) {
    vec4 before = previousFrame(texelFetch(clock, ivec2(0), 0));
    float look = depth + 3.1 * waveLength + 5.3 * waveSlope + 7.7 * spread + 0.13 * windAngle
        + 0.3 * sunElevation + 0.17 * sunAngle + 13.9 * dispersion + 17.1 * animation;
    colour = vec4(float(iTick & 0xffffu), float(iTick >> 16u), 0.0, 1.0 / 1024.0);
    colour = vec4(colour.xy / 65536.0, look, colour.w);
    if (before.xyz == colour.xyz) colour.w += before.w;
}

void mainLanding(out vec4 middle, out vec4 pair, in vec2 pixel) {
    ivec2 cell = ivec2(pixel);
    middle = pair = vec4(0.0);
    if (max(cell.x, cell.y) >= meshCells()) return;
    vec2 start = method == kPhotons ? photonStart(cell, photonPass()) : vec2(0.0);
    landingOf((vec2(cell) + start) / float(meshCells()), true, 0, middle, pair);
}
void mainCells(out vec4 colour, in vec2 pixel) {
    bool lone = method == kPhotons;
    ivec2 cell = ivec2(pixel);
    vec2 start = lone ? photonStart(cell, photonPass()) : vec2(0.0);
    colour = landingBox(landing, split, vec2(cell), vec2(0.0), float(meshCells()), start, lone ? 1 : 4);
}
void mainQuads(out vec4 colour, in vec2 pixel) {
    colour = boxOf(cellBoxes, 2.0 * floor(pixel), 2, 1.0 / float(meshCells()));
}
void mainBlocks(out vec4 colour, in vec2 pixel) {
    colour = boxOf(quadBoxes, 2.0 * floor(pixel), 2, 2.0 / float(meshCells()));
}
void mainSupers(out vec4 colour, in vec2 pixel) {
    colour = boxOf(blocks, 4.0 * floor(pixel), 4, 4.0 / float(meshCells()));
}
void mainReach(out vec4 colour, in vec2 pixel) {
    colour = boxOf(supers, vec2(0.0), meshCells() / 16, 0.0);
}

// The quads that may light each square of 4 x 4 texels: of the floor, above them of the two slices.
void mainTiles(out vec4 colour, in vec2 pixel) {
    vec2 tile = floor(pixel);
    float fall = 1.0, side = 1.0 / 64.0;
    colour = vec4(0.0);
    if (tile.y >= 64.0) {
        fall = tile.x < 32.0 ? kLevels.x : kLevels.y;
        tile -= vec2(tile.x < 32.0 ? 0.0 : 32.0, 64.0);
        side = 1.0 / 32.0;
    }
    if (method < kArea || max(tile.x, tile.y) * side >= 1.0) return;
    colour = quadsThatMeet(quadBoxes, blocks, supers, texelFetch(reach, ivec2(0), 0), vec2(0.0),
                           float(meshCells()), side * vec4(tile, tile + 1.0), fall);
}

// The loop of `periodic`: frame k stands in column k % 4 and row k / 4 of each buffer.
void mainFrameLanding(out vec4 middle, out vec4 pair, in vec2 pixel) {
    middle = pair = vec4(0.0);
    if (method != kPeriodic) return;
    ivec2 at = ivec2(pixel), frame = at / kFrameCells;
    vec2 u = vec2(at % kFrameCells) / float(kFrameCells);
    landingOf(u, false, frame.x + 4 * frame.y, middle, pair);
}
void mainFrameCells(out vec4 colour, in vec2 pixel) {
    vec2 at = floor(pixel), cell = wrapped(at, float(kFrameCells));
    colour = landingBox(frameLanding, frameSplit, cell, at - cell, float(kFrameCells), vec2(0.0), 4);
}
void mainFrameQuads(out vec4 colour, in vec2 pixel) {
    colour = boxOf(frameCells, 2.0 * floor(pixel), 2, 1.0 / float(kFrameCells));
}
void mainFrameBlocks(out vec4 colour, in vec2 pixel) {
    colour = boxOf(frameQuads, 2.0 * floor(pixel), 2, 2.0 / float(kFrameCells));
}
void mainFrameSupers(out vec4 colour, in vec2 pixel) {
    colour = boxOf(frameBlocks, 4.0 * floor(pixel), 4, 4.0 / float(kFrameCells));
}
void mainFrameReach(out vec4 colour, in vec2 pixel) {
    colour = boxOf(frameSupers, float(kFrameCells / 16) * floor(pixel), kFrameCells / 16, 0.0);
}
void mainFrameTiles(out vec4 colour, in vec2 pixel) {
    vec2 frame = floor(pixel / 64.0), tile = floor(pixel) - 64.0 * frame;
    colour = quadsThatMeet(frameQuads, frameBlocks, frameSupers,
                           texelFetch(frameReach, ivec2(frame), 0), frame, float(kFrameCells),
                           vec4(tile, tile + 1.0) / 64.0, 1.0);
}
void mainFrames(out vec4 colour, in vec2 pixel) {
    colour = vec4(1.0);
    if (method != kPeriodic) return;
    vec2 frame = floor(pixel / float(kMap)), at = floor(pixel) - float(kMap) * frame;
    colour.rgb = gather(frameLanding, frameSplit, frameCells, frameQuads,
                        fetch(frameTiles, floor(pixel / 4.0), vec2(256.0)), frame, float(kFrameCells),
                        at, float(kMap), 1.0, dispersion > 0.0);
}
// Five frames of the loop, the next fading in while the oldest fades out. Their weights lag by
// 1.2 / 1.05 frames, by which the loop runs ahead.
vec3 blendFrames(ivec2 at) {
    float now = cycles(1.0 / loopSeconds) * float(kFrames) + 1.14;
    float weights[7] = float[7](0.0, 0.4, 0.3, 0.2, 0.1, 0.05, 0.0);
    vec3 sum = vec3(0.0);
    for (int j = 0; j < 6; ++j) {
        int k = (int(now) + 1 - j + kFrames) % kFrames;
        sum += mix(weights[j], weights[j + 1], fract(now))
            * texelFetch(frames, ivec2(k & 3, k >> 2) * kMap + at, 0).rgb;
    }
    return sum / 1.05;
}

void mainCaustics(out vec4 colour, in vec2 pixel) {
    vec2 u = pixel / float(kMap);
    vec3 sun = sunAbove();
    colour = vec4(1.0);
    if (method == kVertical) {         // straight up, and the normal there
        vec2 slope = waterAt(u + levelBend() * depth / kTile, true, 0).slope;
        float cosine = dot(sun, normalize(vec3(-slope.x, 1.0, -slope.y)));
        // Its mean over normal slopes is 1: of (1 + x)^c, exp(c (c - 1) var(x) / 2), nearly.
        float spread = 0.5 * square(waveSlope) * (1.0 - square(sun.y));
        float mean = exp(min(0.5 * contrast * (contrast - 1.0) * spread, 80.0));
        float light = pow(clamp(1.0 + cosine - sun.y, 0.0, 2.0), contrast) / mean;
        colour.rgb = vec3(min(light, 60.0));   // rare crests would carry all of it
    } else if (method == kSnell) {     // back along flat water's ray, and out by Snell's law
        vec2 slope = waterAt(u, true, 0).slope;
        vec3 level = normalize(vec3(-slope.x, 1.0, -slope.y));
        vec3 back = refract(waterMedium().towards, -level, kIorWater.y);
        colour.rgb = vec3(pow(clamp(dot(back, sun), 0.0, 1.0), contrast));
    } else if (method == kPeriodic) {
        colour.rgb = blendFrames(ivec2(pixel));
    } else if (method == kArea && isCalm()) {
        colour.rgb = vec3(inverseLight(u, 1.0));
    } else {
        colour.rgb = gatherNow(floor(pixel), float(kMap), vec2(0.0), 1.0, dispersion > 0.0);
        if (method == kPhotons)
            colour.rgb = mix(previousFrame(texelFetch(caustics, ivec2(pixel), 0)).rgb, colour.rgb,
                             1.0 / float(photonPass()));
    }
}

// The same at two levels above the floor, without colours; then the floor's own.
void mainSlices(out vec4 colour, in vec2 pixel) {
    vec2 u = pixel / float(kSliceMap);
    float bed = textureLod(caustics, u, 1.0).g;
    colour = vec4(mix(vec2(1.0), vec2(bed), kLevels), bed, 1.0);
    if (method < kArea) return;   // these know the floor only: its pattern fades upwards
    for (int i = loopStart(); i < 2; ++i)
        colour[i] = method == kArea && isCalm() ? inverseLight(u, kLevels[i])
            : gatherNow(floor(pixel), float(kSliceMap), vec2(32 * i, 64), kLevels[i], false).g;
    if (method == kPhotons)
        colour.xy = mix(previousFrame(texelFetch(slices, ivec2(pixel), 0)).xy, colour.xy,
                        1.0 / float(photonPass()));
}

// ---- Image --------------------------------------------------------------------------------------
// The eye stands in the water and goes round a point of the floor. A pixel's noise moves the
// samples of the shafts; it is the finest grain, which the eye averages.

// Light to display: clamped first, then the largest channel rolls off, the others keep their ratio
// to it, with a little white at the top as on film; then sRGB. NaN and negatives 0, infinity 1.
vec3 display(vec3 light) {
    vec3 x = mix(vec3(0.0), min(light, 65504.0), greaterThan(light, vec3(0.0)));
    float peak = max(maxComponent(x), 1e-6), rolled = 1.0 - exp(-peak);
    vec3 c = mix(x * (rolled / peak), vec3(rolled), 0.35 * pow(rolled, 12.0));
    c = clamp(c, 0.0, 1.0);
    return mix(12.92 * c, 1.055 * pow(max(c, 1e-6), vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c));
}

// What hides the bands of a smooth picture of 255 steps: half a step, up or down by chance. It is
// the same for all samples of a pixel: their mean is rounded, and of many none would be left.
vec3 dither(vec2 fragCoord) {
    vec3 chance = random3(ivec3(16 * ivec2(fragCoord) + 8, 3));
    return (chance + chance.yzx - 1.0) * (0.5 / 255.0);
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    bool dragged = iMouse != vec4(0.0);   // the middle of the picture is the camera's own place
    vec2 orbit = dragged ? iMouse.xy / iResolution.xy - 0.5 : vec2(0.0);
    float angle = radians(cameraAngle) - 2.0 * kPi * orbit.x;
    float height = clamp(cameraHeight - 4.0 * orbit.y, 0.05, depth - 0.1);
    vec3 right = vec3(cos(angle), 0.0, -sin(angle)), back = vec3(sin(angle), 0.0, cos(angle));
    vec3 ro = cameraDistance * back + targetShift * right;
    if (ground == 1) ro.xz = clamp(ro.xz, 0.1 - kPool, kPool - 0.1);
    if (objects == 2) {   // not from inside a column
        vec2 place = vec2(ro.x < 0.0 ? -1.5 : 1.5,
                          kColumnGap * clamp(floor(ro.z / kColumnGap + 0.5), -3.0, 0.0));
        vec2 away = ro.xz - place + 1e-4;   // somewhere from the very middle
        ro.xz += away * max(0.45 * inversesqrt(dot(away, away) + 1e-12) - 1.0, 0.0);
    }
    ro.y = height;
    vec2 aim = vec2(max(cameraDistance, 1e-3), targetHeight - height);   // ahead, up
    aim *= inversesqrt(dot(aim, aim));
    vec3 forward = vec3(0.0, aim.y, 0.0) - aim.x * back, up = cross(right, forward);
    vec2 uv = (fragCoord - 0.5 * iResolution.xy) / iResolution.y;
    float lens = focalLength / 24.0;
    vec3 rd = normalize(uv.x * right + uv.y * up + lens * forward);
    float falloff = square(dot(rd, forward));   // half of a simple lens's cos^4
    // Evenly apart among the samples of a pixel, too.
    float jitter = fract(shuffledQuarters(ivec2(fragCoord)) + fragCoord.x);
    vec3 light = render(ro, rd, 1.0 / (lens * iResolution.y), jitter);
    fragColor = vec4(display(exp2(exposure) * falloff * light) + dither(fragCoord), 1.0);
}
