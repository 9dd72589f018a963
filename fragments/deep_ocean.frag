// Deep ocean: the wreck of a sailing ship on the sea floor.
//
// A ship lies in sand under a cliff, its side broken open, torn sails on leaning masts. Sunlight
// comes down in shafts and as a net of light; kelp sways, jellyfish pulse and glow through the
// haze, above stands the dome of the surface.
//
// Method   The floor is a height field, drawn once: two bands of Perlin noise under sand. Rays walk
//          over the highest points of large and small cells, inside a cell by steps that its
//          steepest slope bounds. The hull is a field that never exceeds the distance. Masts,
//          ropes, sails and kelp are closed forms: each gives the share of the pixel that it
//          covers, kept in a short list by distance and blended in order, so edges are clean from
//          any distance and nothing behind a tear is veiled. A sail's tears are a noise compared
//          with a bound: what a mip level has lost of its variance softens the edge.
//          Light: each point of the waves' tile sends a Gaussian to where Snell's law lands it, as
//          wide as its neighbours come to lie apart; the sum is the net of light, periodic in space
//          and time. Water is exact for even light; shafts and the cliff's shadow are added by few
//          samples, each exact in its own extinction.
// Sources  Perlin, SIGGRAPH (2002): noise. Jarzynski and Olano, JCGT 9(3) (2020): pcg3d. Tevs,
//          Ihrke, Seidel, I3D (2008): walks over highest points. Hart, Visual Computer 12 (1996):
//          sphere tracing. Igehy, SIGGRAPH (1999): ray differentials. Stam, Random caustics,
//          SIGGRAPH (1996): periodic tiles. Henyey and Greenstein, ApJ 93 (1941): phase. Born and
//          Wolf, Principles of Optics, 1.5: Fresnel. Sun et al., SIGGRAPH (2005): airlight.
// Units    1 unit = 1 m, y up from the sand, linear sRGB colour until the display curve. The wreck
//          has a frame of its own: x to the bow, y up from the keel, z to starboard.
// Passes   ground to grain: on change of a tweak only. things, surface, splat, gathered, caustics:
//          every frame, small.
// Bounds   The loops of a pixel stay below 30,000 turns with every reference on.
// Defaults From `glint study presets/deep_ocean.toml`: marchSteps 128 would draw what 1024 do; 256
//          leave no more than 0.1 % of the rays out of steps over any floor; 24 shaftSamples are
//          0.008 from 256, and 16 were 0.014, in 0.95 of the time; so in the other presets.
// Licence  MIT

// ---- Tweaks -------------------------------------------------------------------------------------
//@ group Water
uniform float depth;           //@ 24 [16, 40] unit=m "from the surface to the sand"
uniform vec3  waterTint;       //@ #5eb9d6 "what white light becomes over the distance below"
uniform float tintDistance;    //@ 16 [1, 100] log unit=m "that light goes to take on the tint"
uniform float haze;            //@ 0.012 [0, 0.2] unit=1/m "light scattered out of its way"
uniform float waveSlope;       //@ 0.08 [0, 0.25] "of the surface, root mean square"
uniform float specks;          //@ 1.0 [0, 4] "marine snow"
uniform float animation;       //@ 1.0 [0, 4] "speed of everything that moves"
//@ group Light
uniform float sunElevation;    //@ 28 [15, 90] unit=deg "above the horizon"
uniform float sunAngle;        //@ 4 [-180, 180] unit=deg "round the axis; 0 is ahead"
uniform float sunPower;        //@ 28 [0, 40] "irradiance of a face towards the sun"
uniform float skyLight;        //@ 0.5 [0, 4] "of the open sky"
uniform float netContrast;     //@ 0.7 [0, 2] "of the net of light on everything"
uniform float netSharpness;    //@ 0.7 [0, 1] "how well the waves focus"
uniform float loopSeconds;     //@ 16 [2, 64] unit=s "after which the waves repeat"
uniform float shafts;          //@ 2.0 [0, 4] "contrast of the light in the water"
//@ group Sea floor
uniform float wideRelief;      //@ 30 [0, 60] unit=m "height of the wide band of noise"
uniform float fineRelief;      //@ 20 [0, 40] unit=m "height of the fine band of noise"
uniform float cliff;           //@ 21 [0, 36] unit=m "height of the cliff"
uniform float ripples;         //@ 1.0 [0, 2] "of the sand"
uniform int   kelp;            //@ 48 [0, 60] "plants"
uniform float kelpHeight;      //@ 7.0 [1, 14] unit=m "of a plant"
//@ group Wreck
uniform bool  wreck;           //@ on "the ship"
uniform float wreckAngle;      //@ 148 [-180, 180] unit=deg "where the bow points; 0 is right"
uniform float heel;            //@ 13 [-25, 25] unit=deg "of the ship to starboard"
uniform bool  rigging;         //@ on "masts, yards and ropes"
uniform float sailCloth;       //@ 0.5 [0, 1] "how much of the sails is left; 0: none"
//@ group Jellyfish
uniform int   jellyfish;       //@ 7 [0, 12] "how many"
uniform float jellyGlow;       //@ 1.0 [0, 8] "their light"
uniform bool  jellyLamps;      //@ off "they light what is near"
uniform vec3  jellyColour;     //@ #8fdcff "of their light"
uniform float jellyReach;      //@ 0.35 [0, 1] "share of the haze that dims it; 1: as all else"
//@ group Camera
uniform float cameraDistance;  //@ 18 [5, 45] unit=m "from the wreck"
uniform float cameraAngle;     //@ 10 [-180, 180] unit=deg "round the wreck"
uniform float cameraHeight;    //@ 1.6 [0.3, 38] unit=m "of the eye, and never in the ground"
uniform float targetHeight;    //@ 7.6 [0, 30] unit=m "of the point looked at"
uniform float targetShift;     //@ 0.0 [-15, 15] unit=m "of the point looked at, to the right"
uniform float focalLength;     //@ 17 [12, 120] log unit=mm "of a lens on 36 x 24 mm film"
uniform float exposure;        //@ 0.3 [-4, 6] unit=stop "before the display curve"
//@ group Quality
uniform int   march;           //@ 0 {bounded, even} norandom "steps to the floor; even: to compare"
uniform int   marchSteps; //@ 256 [16, 1024] log quality reference=1024 second=march=even "of a ray to the floor"
uniform int   shaftSamples;    //@ 24 [1, 256] log quality reference=256 "along one view ray"
uniform int   antialias;       //@ 1 [1, 16] quality reference=16 "samples of a pixel"
uniform int   cutout;          //@ 1 {threshold, coverage} "how thin things and tears are cut out"

precision highp sampler2D;     // the default is lowp: Mesa then reads 32-bit buffers as halves
uniform sampler2D ground;      //@ pass mainGround size=1024x1024 format=rg32f wrap=repeat
uniform sampler2D relief;      //@ pass mainRelief size=1024x1024 wrap=repeat filter=mipmap
uniform sampler2D tops;        //@ pass mainTops size=128x128 wrap=repeat filter=nearest
uniform sampler2D summits;     //@ pass mainSummits size=32x32 format=r32f wrap=repeat filter=nearest
uniform sampler2D shade;       //@ pass mainShade size=256x256 format=rg32f wrap=repeat
uniform sampler2D grain;       //@ pass mainGrain size=256x256 wrap=repeat filter=mipmap
uniform sampler2D things;      //@ pass mainThings size=64x5 filter=nearest
uniform sampler2D surface;     //@ pass mainSurface size=128x128 wrap=repeat filter=mipmap
uniform sampler2D splat;       //@ pass mainSurface size=128x128 wrap=repeat filter=nearest
uniform sampler2D gathered;    //@ pass mainGathered size=64x64 filter=nearest
uniform sampler2D caustics;    //@ pass mainCaustics size=128x128 format=r32f wrap=repeat filter=mipmap

// ---- Constants and numbers ----------------------------------------------------------------------
// Lengths are metres; the floor and the waves repeat after squares of their own, so that a buffer
// holds all of them. What a ray meets is told by its kind, from kSand to kWeed.

const float kPi = 3.14159265358979;
const float kGolden = 0.61803398874989;    // turns between neighbours of a phyllotaxis
const float kFar = 1e9;                    // m, a miss
const float kIorWater = 1.34;              // visible light
const float kTile = 256.0;                 // m, after which the floor repeats, far beyond sight
const int   kGround = 1024;                // texels of the floor, a side
const float kClearance = 3.0;              // m, of water over the highest floor
const float kEvenMarch = 160.0;            // m, of a ray, which even steps share: beyond sight
const float kCell = 2.0, kPatch = 8.0;     // m, of the cells of `tops` and of `summits`
const float kNet = 8.0;                    // m, tile of the waves
const int   kNetTexels = 128, kWaves = 10, kReach = 8;   // kReach: texels that light moves aside
const float kOctaves = 0.8493218003;       // exp(-0.5 x^2) is exp2(-square(kOctaves * x))
const float kSplatSteps = 340.0;           // a texel, of what `splat` keeps in 12 bits
const float kGravity = 9.81;               // m/s^2
const vec3  kWreckAt = vec3(0.0, -1.25, 0.0);            // m, the keel amidships
const float kPitch = 0.07;                 // rad, of the ship, stern down
const int   kHullSteps = 90;               // of a ray to the hull
const float kStrakes = 15.0;               // planks from keel to rail
const float kFrames = 0.75, kBeams = 1.5;  // m, between frames, between beams
const int   kSpars = 10, kShrouds = 12, kStays = 5, kSails = 5;
// Where sails hang, with their fall, and how much they belly: four yards and the forestay.
const vec4  kYardFrom[kSails] = vec4[kSails](
    vec4(2.3, 9.0, -2.9, 4.2), vec4(3.0, 14.0, -2.0, 3.6), vec4(-4.9, 10.9, -2.9, 4.2),
    vec4(-3.8, 15.6, -2.2, 3.6), vec4(14.5, 8.0, 0.0, 5.0));
const vec4  kYardTo[kSails] = vec4[kSails](
    vec4(8.9, 9.8, 2.9, 1.0), vec4(7.9, 13.2, 2.0, 0.85), vec4(2.9, 9.2, 3.1, 0.7),
    vec4(1.7, 16.2, 2.2, 0.55), vec4(6.6, 15.2, 0.0, 0.8));
const int   kSand = 1, kPlank = 2, kTimber = 3, kSpar = 4, kRope = 5, kSail = 6, kWeed = 7;
const float kRim = 5.0;                    // of wood before the sun, of the field's light
const float kLap = 2.2;                    // slope of a strake from its middle to its edges
const float kSandBack = 0.8, kSandReach = 6.0;   // share of light that sand throws up; m
const int   kLayers = 4;                   // things in front of each other that are kept
const float kSpeckCell = 0.8;              // m, one speck in each; repeats after 32

struct Medium { vec3 absorption, extinction, diffuse, towards, sun; };   // 1/m; unit; irradiance
struct Eye { vec3 pos, right, up, forward; float lens; };
struct Layer { float t, cover; int kind; vec3 nor; };

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
vec4 thing(int k, int row) { return fetch(things, vec2(k, row), vec2(64.0, 5.0)); }

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
vec3 unit(vec3 v) { return v * inversesqrt(max(dot(v, v), 1e-30)); }
vec3 linearColour(vec3 c) {   // from sRGB, a fit to 1/500
    return c * (c * (c * 0.305306011 + 0.682171111) + 0.012522878);
}
int lowestBit(int mask) { return (floatBitsToInt(float(mask & -mask)) >> 23) - 127; }
vec3 safeInverse(vec3 rd) {   // never infinite, so a slab never multiplies 0 by infinity
    return 1.0 / mix(rd, vec3(1e-20), lessThan(abs(rd), vec3(1e-20)));
}
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

// Share of a pixel of width w, its middle at x, that lies between a and b.
float overlap(float x, float w, float a, float b) {
    w = max(w, 1e-5);
    return clamp((min(x + 0.5 * w, b) - max(x - 0.5 * w, a)) / w, 0.0, 1.0);
}

// ---- The floor ----------------------------------------------------------------------------------
// Perlin's gradient noise, -1 to 1. The cell comes in whole numbers and the place in it apart, so
// that it is as smooth far from the origin as near it; period: cells, a power of two.
float seabedNoise(ivec2 cell, vec2 f, int period, int seed) {
    vec2 s = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
    vec4 corner;
    for (int k = 0; k < 4; ++k) {
        ivec2 c = ivec2(k & 1, k >> 1);
        vec2 gradient = 2.0 * random3(ivec3((cell + c) & (period - 1), seed)).xy - 1.0;
        corner[k] = dot(gradient, f - vec2(c));
    }
    return mix(mix(corner.x, corner.y, s.x), mix(corner.z, corner.w, s.x), s.y);
}
// The same over the floor, in cells of so many metres.
float floorNoise(vec2 p, float cell, int seed) {
    vec2 q = p / cell, c = floor(q);
    return seabedNoise(ivec2(c), q - c, int(kTile / cell), seed);
}
float smoothMax(float a, float b, float k) {
    float h = max(k - abs(a - b), 0.0) / k;
    return max(a, b) + 0.25 * k * h * h;
}

// Height of the floor at (x, z) from the wreck, -kTile / 2 to kTile / 2, and how much it is rock.
vec2 floorShape(vec2 p) {
    float wide = 0.5 * wideRelief * floorNoise(p, 64.0, 1), fine = 0.0, gain = 0.5 * fineRelief;
    for (int k = 0; k < 5; ++k) {   // down to four texels
        fine += gain * floorNoise(p, 16.0 * exp2(float(-k)), 2 + k);
        gain *= 0.42;
    }
    float along = 2.0 * kPi * p.x / kTile, clear = exp(-dot(p, p) / 260.0);
    float beyond = 20.0 * sin(along + 0.6) + 4.0 * floorNoise(p, 32.0, 8) - p.y - 34.0;
    float face = smoothstep(-3.0, 6.0, beyond + 0.35 * fine);
    float back = smoothstep(-3.0, 9.0, p.y - 88.0 + 0.5 * fine);   // closes the tile
    float rock = wide + fine - 2.4 - 14.0 * clear + cliff * max(face, back);
    rock += 0.9 * face * sin(rock);                                // ledges
    float sand = 0.8 * floorNoise(p, 32.0, 20) + 0.22 * floorNoise(p, 8.0, 21);
    sand = sand * (1.0 - 0.7 * clear) + 2.6 * smoothstep(-24.0, 2.0, beyond);   // scree
    float share = smoothstep(-0.2, 0.5, rock - sand), height = smoothMax(rock, sand, 0.7);
    return vec2(-smoothMax(-height, kClearance - depth, 3.0), share);
}
float groundHeight(vec2 p) { return textureLod(ground, p / kTile, 0.0).x; }

int seabedEvaluations = 0;   // of a ray's height over the floor, for measurements

// Where a ray from above meets the floor, or -1. pixel: angle of a pixel, rad. Cells whose highest
// point lies below the ray are crossed in one step; elsewhere no step is longer than the steepest
// rise allows that the cell has in the ray's direction, but none is shorter than `least`. The last
// few go to where a line through both ends is 0, and halve the gap at the end that stayed (after
// Illinois).
float hitSeabed(vec3 ro, vec3 rd, float pixel, float tMax) {
    seabedEvaluations = 0;
    float level = length(rd.xz), t = 0.0, least = 9.0 / float(marchSteps);   // m
    vec2 inverse = safeInverse(vec3(rd.xz, 1.0)).xy, far = step(0.0, rd.xz);
    vec2 nudge = 1e-3 * sign(rd.xz), above = vec2(0.0), below = vec2(-1.0, 0.0);
    if (rd.y > 0.0) tMax = min(tMax, (depth - kClearance - ro.y) / rd.y);
    for (int k = 0; k < marchSteps && below.x < 0.0 && t < tMax; ++k) {
        vec3 p = ro + t * rd;
        vec2 large = floor((p.xz + nudge) / kPatch), cell = floor((p.xz + nudge) / kCell);
        vec2 leaveLarge = ((large + far) * kPatch - ro.xz) * inverse;
        vec2 leave = ((cell + far) * kCell - ro.xz) * inverse;
        float tLarge = max(min(leaveLarge.x, leaveLarge.y), t);
        float tCell = max(min(leave.x, leave.y), t);
        float topLarge = fetch(summits, large, vec2(32.0)).x;
        vec4 top = fetch(tops, cell, vec2(128.0));
        bool overLarge = march == 0 && min(p.y, ro.y + tLarge * rd.y) > topLarge;
        bool over = overLarge || (march == 0 && min(p.y, ro.y + tCell * rd.y) > top.x);
        float next = overLarge ? tLarge : tCell;
        if (over) above = vec2(t, p.y - top.x);   // or higher
        if (!over) {
            float f = p.y - groundHeight(p.xz);
            float closing = dot(top.yz, rd.xz) + top.w * level - rd.y;
            next = min(t + f / max(closing, 1e-3), tCell);
            if (f <= 0.0) below = vec2(t, f);
            else above = vec2(t, f);
        }
        ++seabedEvaluations;
        float even = kEvenMarch / float(marchSteps);
        t = march == 0 ? max(next, t + least + 0.3 * pixel * t) : t + even;
    }
    if (below.x < 0.0) return -1.0;
    float f = 1.0;
    for (int k = loopStart(); k < 4 && abs(f) > 1e-5; ++k) {   // m
        float s = mix(above.x, below.x, above.y / max(above.y - below.y, 1e-20));
        f = ro.y + s * rd.y - groundHeight(ro.xz + s * rd.xz);
        if (f > 0.0) {
            above = vec2(s, f);
            below.y *= 0.5;
        } else {
            below = vec2(s, f);
            above.y *= 0.5;
        }
        ++seabedEvaluations;
    }
    return mix(above.x, below.x, above.y / max(above.y - below.y, 1e-20));
}

// ---- The wreck ----------------------------------------------------------------------------------
// The hull is where a point lies within the curve of its section: at a station x that curve is a
// power of the height. How far |z| passes it, divided by the slope's length, is nearly the distance
// and kept below it; planks, frames, beams and the hole are cut and joined by max and min. A ray
// steps by that field and cannot pass through (sphere tracing, Hart).

mat3 gWreck;   // her axes in the world, as columns
void readWreck() {
    for (int i = 0; i < 3; ++i) {
        vec3 v = vec3(i == 0, i == 1, i == 2);
        v.yz = turn(v.yz, -radians(heel));
        v.xy = turn(v.xy, -kPitch);
        v.xz = turn(v.xz, -radians(wreckAngle));
        gWreck[i] = v;
    }
}
vec3 toWreck(vec3 v) { return v * gWreck; }
vec3 fromWreck(vec3 v) { return gWreck * v; }
// Where a ray is in a box.
vec2 boxSpan(vec3 ro, vec3 rd, vec3 lo, vec3 hi) {
    vec3 inverse = safeInverse(rd), a = (lo - ro) * inverse, b = (hi - ro) * inverse;
    vec3 n = min(a, b), f = max(a, b);
    return vec2(max(maxComponent(n), 0.0), min(f.x, min(f.y, f.z)));
}
vec2 hullSpan(vec3 ro, vec3 rd) {
    return boxSpan(ro, rd, vec3(-12.3, -0.5, -3.4), vec3(12.9, 7.0, 3.4));
}

// The hull's shape: distance to its outer side (inside negative), height in it from 0 at the keel
// to 1 at the rail, height of the rail, and of the side from keel to rail.
vec4 hullSide(vec3 p) {
    bool fore = p.x > 0.0;
    float reach = fore ? 9.9 + 0.42 * clamp(p.y, 0.0, 6.0) : 11.0, s = p.x / reach;
    float sheer = 4.2 + 0.011 * p.x * p.x, keel = 0.05 * square(max(abs(p.x) - 6.0, 0.0));
    float tall = sheer - keel, v = clamp((p.y - keel) / tall, -0.3, 1.3), under = 1.0 - v;
    float plan = fore ? max(1.0 - s * s * s, 0.0) : 1.0 - 0.45 * s * s;
    float section = 1.0 - under * under * under;
    float rise = 9.0 * plan * under * under / tall;
    float run = 3.0 * section * (fore ? 3.0 * s * s : 0.9 * s) / reach;
    float side = (abs(p.z) - 3.0 * plan * section) * inversesqrt(1.0 + rise * rise + run * run);
    return vec4(0.85 * side, v, sheer, tall);
}
// Two numbers for a plank or a frame: terms of the R2 sequence, many times cheaper than a hash.
vec2 spread(float n) { return fract(n * vec2(0.7548777, 0.5698403)); }
// Distance to the hull, never more than the true one, and what is there. Where parts repeat and
// differ, the next one is assumed whole, so a step never passes it.
vec2 map(vec3 p) {
    vec4 hull = hullSide(p);
    float side = hull.x, sheer = hull.z, deck = sheer - 1.15, inside = side + 0.12;
    float rim = min(p.y - sheer, max(p.y - sheer - 1.15, p.x + 5.4));
    // Planking, broken open to port: each strake ends where it tore.
    float strake = floor(hull.y * kStrakes), part = hull.y * kStrakes - strake;
    vec2 r = spread(strake);
    float open = 3.7 * smoothstep(0.1, 0.7, (strake + 0.5) / kStrakes) + 1.2 * (r.x - 0.5);
    float gap = p.z < 0.0 ? open - abs(p.x - 0.7 - 1.1 * (r.y - 0.5)) : -1.0;
    gap = min(gap, min(part, 1.0 - part) * hull.w / kStrakes + 0.03);
    float shell = max(max(max(side, -side - 0.13), max(rim, -11.0 - p.x)), gap);
    shell = min(shell, max(abs(p.x + 11.0) - 0.08, max(side, rim)));   // transom
    float keel = max(max(abs(p.z) - 0.1, abs(p.x - 0.3) - 11.9), abs(p.y - 0.3) - 0.5);
    shell = min(shell, max(keel, 0.3 * side));
    // Frames, some of them broken off.
    float place = floor(p.x / kFrames + 0.5), off = abs(p.x - kFrames * place);
    r = spread(place + 40.0);
    float band = max(abs(side + 0.28) - 0.14, abs(p.x) - 9.9);
    float broken = p.z < 0.0 && abs(p.x - 0.7) < 4.5 ? 0.35 - 2.0 * r.x * r.x : 0.0;
    float frames = max(max(off - 0.08, band), p.y - sheer - broken);
    frames = min(frames, max(max(0.66 - off, band), p.y - sheer - 0.35));
    // Decks, torn open amidships, and the beams that carried them.
    float lane = p.z / 0.3, board = floor(lane);
    lane -= board;
    r = spread(board + 20.0);
    float torn = min(p.x + 2.8 + 1.6 * r.x, 5.0 + 1.4 * r.y - p.x);
    torn = min(torn, 0.3 * min(lane, 1.0 - lane) + 0.03);
    float decks = max(max(abs(p.y - deck) - 0.06, inside), torn);
    decks = min(decks, max(max(abs(p.y - sheer - 0.1) - 0.06, inside), p.x + 5.4));
    decks = max(decks, -10.95 - p.x);
    float wall = max(max(abs(p.x + 5.4) - 0.06, inside), abs(p.y - sheer + 0.5) - 0.64);
    wall = max(wall, min(0.5 - abs(p.z + 0.8), sheer + 0.55 - p.y));   // a doorway
    place = floor(p.x / kBeams + 0.5);
    off = abs(p.x - kBeams * place);
    band = max(max(abs(p.y - deck + 0.2) - 0.13, inside), abs(p.x) - 9.0);
    float beams = max(spread(place + 9.0).y < 0.7 ? off - 0.1 : 1.3 - off, band);
    beams = min(beams, max(1.3 - off, band));
    float rudder = max(max(abs(p.z) - 0.09, abs(p.x + 11.6) - 0.55), abs(p.y - 1.7) - 2.2);
    float timber = min(min(frames, beams), min(wall, rudder));
    return decks < min(shell, timber) ? vec2(decks, kTimber)
        : shell < timber ? vec2(shell, kPlank) : vec2(timber, kTimber);
}

// In the wreck's frame. What is hit, or 0. When the march is over, the same loop turns four times
// more, at the corners of a tetrahedron, for the normal: so the map is called in one place, for a
// driver compiles a copy for each.
int hitHull(vec3 ro, vec3 rd, float pixel, float tMax, out float t, out vec3 nor) {
    vec2 span = hullSpan(ro, rd);
    t = span.x;
    nor = vec3(0.0, 1e-6, 0.0);
    float end = min(span.y, tMax);
    vec3 aside = vec3(0.0);
    int kind = 0, corner = -1;   // -1 on the way
    bool open = t < end;
    for (int k = 0; k < kHullSteps + 4 && open; ++k) {
        vec2 d = map(ro + t * rd + aside);
        nor += aside * d.x;
        if (kind == 0) {
            if (d.x < 0.4 * pixel * t + 1e-3) kind = int(d.y);
            else t += d.x;
        }
        if (kind > 0) ++corner;
        open = kind > 0 ? corner < 4 : t < end && k < kHullSteps - 1;
        vec3 e = vec3((corner + 3 >> 1) & 1, corner >> 1, corner & 1) * 2.0 - 1.0;
        if (kind > 0) aside = 0.015 * e;
    }
    nor = unit(nor);
    return kind;
}
// Part of the sun that a face sees past the hull; the surface spreads its light by `blur` rad. Where
// it is near her, open tells from the room in front of it how little she closes it in.
float besideHull(vec3 p, vec3 nor, vec3 towards, float blur, bool near, out float open) {
    vec3 start = p + 0.05 * nor;
    vec2 span = hullSpan(start, towards);
    float seen = 1.0, t = max(span.x, 0.03);
    open = 1.0;
    for (int k = near ? -1 : 0; k < 14 && (k < 0 || t < span.y && seen > 0.0); ++k) {
        float d = map(k < 0 ? p + 0.8 * nor : start + t * towards).x;
        if (k < 0) {
            open = clamp(0.25 + 0.9 * d, 0.0, 1.0);
        } else {
            seen = min(seen, 0.5 + 0.5 * d / (blur * t));
            t += clamp(d, 0.06, 1.5);
        }
    }
    seen = max(seen, 0.0);
    return seen * seen * (3.0 - 2.0 * seen);
}

// ---- Thin things --------------------------------------------------------------------------------
// A rope is thinner than a pixel. So it is not hit or missed: it covers a share of the pixel, the
// overlap of two intervals. What covers a pixel in part is kept in a list of kLayers by distance
// and blended in that order, each behind what the nearer ones leave open: share = cover prod (1 -
// cover). An edge is then clean from any distance, and behind a tear stands what is really there.

Layer layers[kLayers];   // of this pixel, the nearest first

void addLayer(Layer l) {
    if (cutout == 0) l.cover = step(0.5, l.cover);
    if (l.cover < 0.004) return;
    for (int i = 0; i < kLayers; ++i)
        if (l.t < layers[i].t) {
            Layer farther = layers[i];
            layers[i] = l;
            l = farther;
        }
}
// How much of layer i lies before t, 0 to 1: what is nearer than a pixel's width to something else
// crosses it within the pixel.
float isBefore(int i, float t, float pixel) {
    return clamp(0.5 + (t - layers[i].t) / (pixel * t), 0.0, 1.0);
}
// Turns each layer's cover into the share of the pixel in which it is seen.
void coverToShare(float pixel) {
    float share[kLayers], sum = 0.0, open = 1.0;
    for (int i = 0; i < kLayers; ++i) {
        share[i] = layers[i].cover;
        open *= 1.0 - layers[i].cover;
        for (int j = 0; j < kLayers; ++j)
            if (j != i) share[i] *= 1.0 - isBefore(j, layers[i].t, pixel) * layers[j].cover;
        sum += share[i];
    }
    for (int i = 0; i < kLayers; ++i)   // the sum is right already, but where three cross
        layers[i].cover = share[i] * (1.0 - open) / max(sum, 1e-6);
}
// Share of the pixel that layers leave open as far as t, of their shares.
float openTo(float t, float pixel) {
    float open = 1.0;
    for (int i = 0; i < kLayers; ++i) open -= isBefore(i, t, pixel) * layers[i].cover;
    return max(open, 0.0);
}

// A tapering pole: the pixel's share of it, where its surface is, its normal; a round end.
Layer spar(int k, vec3 ro, vec3 rd, float pixel) {
    vec4 a = thing(k, 0), b = thing(k, 1);
    vec3 axis = b.xyz - a.xyz, f = a.xyz - ro;
    float size = dot(axis, axis), lean = dot(axis, rd), fd = dot(f, rd);
    float s = clamp((fd * lean - dot(f, axis)) / max(size - lean * lean, 1e-4 * size), 0.0, 1.0);
    float t = max(fd + s * lean, 1e-3), r = mix(a.w, b.w, s), w = pixel * t;
    vec3 off = ro + t * rd - (a.xyz + s * axis);
    float d = length(off), height = sqrt(max(r * r - d * d, 0.0));
    vec3 back = unit(lean / size * axis - rd);
    Layer l = Layer(t, 0.0, k < kSpars ? kSpar : kRope, unit(off + height * back));
    if (fd + s * lean > 0.1) l.cover = overlap(d, w, -r, r);
    l.t = max(t - height, 1e-3);
    return l;
}

// Cloth is where a noise lies below this: whole at the yard, shreds at the foot.
float clothBound(vec2 p, vec2 size) {
    float down = clamp(p.y / size.y, 0.0, 1.0), across = abs(2.0 * p.x / size.x - 1.0);
    return 0.1 + 0.85 * sailCloth + 0.35 * (1.0 - down) - 0.75 * down * down * down
        - 0.2 * across * across * down;
}
// A jib's fall grows along its stay.
vec2 sailSize(float x, vec2 size, int k) {
    return vec2(size.x, k == 4 ? size.y * clamp(x / size.x, 0.05, 1.0) : size.y);
}
// The pixel's share of cloth at p, m from the sail's upper corner; w: its width along both, m.
float clothCover(vec2 p, vec2 size, float seed, vec2 w) {
    vec2 scale = vec2(2.4, 6.0);   // m, the grain is drawn out along the fall of the threads
    float lod = log2(max(max(w.x / scale.x, w.y / scale.y) * 256.0, 1.0));
    vec4 g = textureLod(grain, p / scale + vec2(0.37, 0.21) * seed, lod);
    // What a pixel holds differs by the grain's slopes and lost variance and by the bound's own
    // slope: as an even distribution of that width, about a mean that the bound's curve shifts.
    float lost = max(g.y - g.x * g.x, 0.0), slope = length(g.zw * w / scale);
    float down = clamp(p.y / size.y, 0.0, 1.0), part = w.y / size.y;
    float fall = (0.35 + 2.25 * down * down) * part;
    float soft = sqrt(12.0 * lost + slope * slope + fall * fall + 1e-5);
    float inside = overlap(p.x, w.x, 0.0, size.x) * overlap(p.y, w.y, 0.0, size.y);
    float bound = clothBound(p, size) - 0.19 * down * part * part;
    return inside * clamp(0.5 + (bound - g.x) / soft, 0.0, 1.0);
}
// A sail in its own coordinates: along the yard, down, and out of its plane. It bellies as a
// parabola down its fall, bend.x v + bend.y v^2, and sways. With a constant k all but the sway is
// constant.
struct Sail { vec3 corner; mat3 into; vec2 size, bend; };
Sail sail(int k) {
    vec3 from = kYardFrom[k].xyz, along = kYardTo[k].xyz - from;
    vec3 down = toWreck(vec3(0.0, -1.0, 0.0));
    float wide = length(along), now = 2.0 * kPi * (cycles(0.09375) + 0.37 * float(k));
    along /= wide;
    vec2 bend = vec2(0.14 + 0.10 * sin(now), (-0.5 + 0.7 * cos(now - 0.8)) * 0.09);
    mat3 into = inverse(mat3(along, down, unit(cross(along, down))));
    return Sail(from + 0.04 * wide * along, into, vec2(0.92 * wide, kYardFrom[k].w),
                bend * kYardTo[k].w);
}
// The two places where a ray meets a sail's parabola, as t, and nothing where it does not.
vec2 sailRoots(vec3 q, vec3 qd, vec2 bend) {
    float a = bend.y * qd.y * qd.y, c = bend.x * q.y + bend.y * q.y * q.y - q.z;
    float b = bend.x * qd.y + 2.0 * bend.y * q.y * qd.y - qd.z, d = b * b - 4.0 * a * c;
    if (d < 0.0) return vec2(-1.0);
    float h = -0.5 * (b + (b < 0.0 ? -1.0 : 1.0) * sqrt(d));
    return vec2(c / (abs(h) > 1e-12 ? h : 1e-12), h / (abs(a) > 1e-12 ? a : 1e-12));
}
bool metSail(float t, vec3 q, vec3 qd, vec2 size, float pixel, float tMax) {
    vec2 p = q.xy + t * qd.xy, slack = vec2(pixel * t);
    return t > 0.2 && t < tMax && all(greaterThan(p, -slack)) && all(lessThan(p, size + slack));
}
// Light that the sails let through on its way to p, in the wreck's frame: by their mean cover.
float besideSails(vec3 p, vec3 towards, float blur) {
    float seen = 1.0;
    for (int k = 0; k < kSails; ++k) {
        Sail one = sail(k);
        vec3 q = one.into * (p - one.corner), qd = one.into * towards;
        float t = sailRoots(q, qd, one.bend).x, w = max(blur * t, 0.3);
        vec2 uv = q.xy + t * qd.xy, size = sailSize(uv.x, one.size, k);
        vec2 inside = clamp(0.5 + min(uv, size - uv) / w, 0.0, 1.0);
        float cloth = clamp(clothBound(uv, size) * 2.0 - 0.5, 0.0, 1.0);
        if (t > 0.05) seen *= 1.0 - 0.75 * inside.x * inside.y * cloth;
    }
    return seen;
}

// Masts, ropes and sails in the wreck's frame: what meets is marked first, then visited.
void meetRig(vec3 ro, vec3 rd, float pixel, float tMax) {
    vec2 span = boxSpan(ro, rd, vec3(-13.0, 0.0, -6.0), vec3(17.0, 20.0, 6.0));
    bool near = span.x < min(span.y, tMax);
    int marks = 0;
    for (int k = 0; k < (near && rigging ? kSpars + kShrouds + kStays : 0); ++k) {
        Layer l = spar(k, ro, rd, pixel);
        if (l.cover > 0.004 && l.t < tMax) marks |= 1 << k;
    }
    for (; marks != 0; marks &= marks - 1) addLayer(spar(lowestBit(marks), ro, rd, pixel));
    if (sailCloth > 0.0)
        for (int k = 0; k < kSails; ++k) {   // bits 2 k and 2 k + 1: the two roots
            Sail one = sail(k);
            vec3 q = one.into * (ro - one.corner), qd = one.into * rd;
            vec2 roots = sailRoots(q, qd, one.bend);
            if (metSail(roots.x, q, qd, one.size, pixel, tMax)) marks |= 1 << (2 * k);
            if (metSail(roots.y, q, qd, one.size, pixel, tMax)) marks |= 2 << (2 * k);
        }
    for (; marks != 0; marks &= marks - 1) {
        int bit = lowestBit(marks), k = bit >> 1;
        Sail one = sail(k);
        vec3 q = one.into * (ro - one.corner), qd = one.into * rd;
        vec2 roots = sailRoots(q, qd, one.bend);
        float t = (bit & 1) == 0 ? roots.x : roots.y, w = pixel * t;
        vec2 uv = q.xy + t * qd.xy, size = sailSize(uv.x, one.size, k);
        vec3 nor = vec3(0.0, one.bend.x + 2.0 * one.bend.y * uv.y, -1.0);   // not unit
        float facing = abs(dot(nor, qd)) * inversesqrt(dot(nor, nor));
        vec2 wide = w * clamp(abs(qd.xy) / max(facing, 0.05) + 1.0, 1.0, 8.0);
        nor.x += 0.3 * sin(5.0 * uv.x + 1.5 * sin(1.3 * uv.y));             // folds
        nor = unit(transpose(one.into) * nor);
        nor *= -sign(dot(nor, rd));
        addLayer(Layer(t, clothCover(uv, size, float(k), wide), kSail, nor));
    }
}

// A plant, seen as a strip that faces the ray: stalk, and blades to both sides in turn.
// u, v: m aside and up; exact across, along rows; swing: of its top, m.
float plantCover(float u, float v, float tall, float swing, float seed, float w) {
    float gapV = 0.34, rows = v / gapV, up = v / tall, sum;
    u -= swing * up * sqrt(max(up, 0.0)) + 0.12 * sin(2.1 * v + seed) * up;
    sum = overlap(u, w, -0.022, 0.022) * step(v, tall);
    float keep = clamp(2.0 - w / gapV, 0.0, 1.0);   // far off blades become an even veil
    for (int k = loopStart(); k < 4; ++k) {
        float blade = floor(rows) - float(k), y = (rows - blade) * gapV, size = 1.35 - 0.6 * up;
        float s = clamp(y / size, 0.0, 1.0), side = mod(blade, 2.0) * 2.0 - 1.0;
        float at = side * (0.55 * s * (1.35 - 0.5 * s)
            + 0.06 * s * sin(3.0 * s - 2.0 * kPi * (cycles(0.25) + 0.23 * blade) + seed));
        float half1 = 0.085 * sin(kPi * s) * (1.0 + 0.15 * sin(19.0 * s));
        half1 *= step(0.0, blade) * step(blade * gapV, tall - 0.35);   // the last ends in its tip
        sum += overlap(u, w, at - half1, at + half1);
    }
    float veil = 0.42 * overlap(u, w, -0.5, 0.5);
    return min(mix(veil, sum, keep), 1.0) * step(0.0, v) * step(v, tall + 0.5);
}
// Whether a ray passes over a group of plants no higher than they grow.
bool meetsGroup(int g, vec3 ro, vec3 rd, float level2) {
    vec4 bound = thing(g, 3);
    vec2 f = bound.xz - ro.xz;
    float t = dot(f, rd.xz) / level2, slack = bound.w + 1.2, part = slack * inversesqrt(level2);
    float low = ro.y + rd.y * (rd.y < 0.0 ? t + part : max(t - part, 0.0));
    float aside = abs(dot(f, vec2(rd.z, -rd.x))) * inversesqrt(level2);
    return aside < slack && t > -part && low < bound.y + 1.0;
}
// A plant: the pixel's share of it, where its strip is, its normal.
Layer plantLayer(int k, vec3 ro, vec3 rd, float level2, float pixel) {
    vec4 plant = thing(k, 2);
    vec2 f = plant.xz - ro.xz, across = vec2(rd.z, -rd.x) * inversesqrt(level2);
    float t = dot(f, rd.xz) / level2, v = ro.y + t * rd.y - plant.y, seed = float(k) * 1.7;
    float swing = 0.12 * plant.w * across.x
        * (0.6 + sin(2.0 * kPi * (cycles(0.09375) + 0.013 * plant.x) - 0.35 * v));
    float cover = plantCover(-dot(f, across), v, plant.w, swing, seed, pixel * t);
    vec3 nor = unit(vec3(0.7 * sin(seed + 5.0 * v) * across, 0.5).xzy - 0.6 * rd);
    return Layer(t, cover * smoothstep(0.5, 1.2, t), kWeed, nor);
}
void meetKelp(vec3 ro, vec3 rd, float pixel, float tMax) {
    float level2 = dot(rd.xz, rd.xz);
    vec2 across = vec2(rd.z, -rd.x) * inversesqrt(level2);
    int groups = 0;
    for (int g = 0; 5 * g < kelp; ++g)
        if (meetsGroup(g, ro, rd, level2)) groups |= 1 << g;
    for (; groups != 0; groups &= groups - 1) {
        int first = 5 * lowestBit(groups), marks = 0;
        for (int k = first; k < min(first + 5, kelp); ++k) {
            vec4 plant = thing(k, 2);
            vec2 f = plant.xz - ro.xz;
            float t = dot(f, rd.xz) / level2, v = ro.y + t * rd.y - plant.y;
            bool met = abs(dot(f, across)) < 1.3 + 0.2 * plant.w && v > 0.0 && v < plant.w + 0.5;
            if (met && t > 0.3 && t < tMax) marks |= 1 << (k - first);
        }
        for (; marks != 0; marks &= marks - 1)
            addLayer(plantLayer(first + lowestBit(marks), ro, rd, level2, pixel));
    }
}

// ---- Light --------------------------------------------------------------------------------------
// Water dims light as exp(-extinction t) (Beer) and scatters it. For even sunlight the light that
// is scattered once into a ray has a closed form, (1 - exp(-x)) / x; shafts are how much less or
// more the sun shines at a few points of the ray. Light that is scattered more often is one soft
// field.

vec3 sunAbove() {   // unit vector towards it
    float e = radians(min(sunElevation, 89.99)), a = radians(sunAngle);
    return vec3(sin(a) * cos(e), sin(e), -cos(a) * cos(e));
}
vec3 skyColour(vec3 rd, float rough) {
    float up = sqrt(clamp(rd.y, 0.0, 1.0)), away = max(1.0 - dot(rd, sunAbove()), 0.0);
    float width = 0.0015 + rough;
    vec3 glare = vec3(1.0, 0.94, 0.84) * sunPower
        * (0.04 * exp(-away / width) / width + 0.10 * exp(-8.0 * away));
    return skyLight * mix(vec3(0.95, 1.1, 1.25), vec3(0.28, 0.58, 1.15), up) + glare;
}
Medium oceanMedium() {
    Medium m;
    m.absorption = -log(clamp(linearColour(waterTint), 1e-3, 0.999)) / tintDistance;
    m.extinction = m.absorption + haze;
    m.diffuse = 1.2 * m.absorption + 0.6 * haze;    // of light from all sides
    vec3 sun = sunAbove();
    vec2 aside = sun.xz / kIorWater;
    m.towards = vec3(aside.x, sqrt(max(1.0 - dot(aside, aside), 0.1)), aside.y);
    float low = exp(-0.12 / sun.y);                  // it reddens near the horizon
    m.sun = sunPower * vec3(1.0, mix(0.75, 0.96, low), mix(0.45, 0.90, low))
        * (1.0 - fresnel(sun.y, kIorWater)) * sun.y / m.towards.y;
    return m;
}
vec3 fieldLight(Medium m) { return skyLight * vec3(0.5, 0.9, 1.1) + 0.25 * m.sun; }   // above
float phaseToSun(vec3 rd, Medium m) {
    float g = 0.72, cosine = dot(rd, m.towards);
    return (1.0 - g * g) / (4.0 * kPi * pow(1.0 + g * g - 2.0 * g * cosine, 1.5)) + 0.03;
}

// Light that the water scatters into a ray of length t, below the surface by `below` at its start:
// of the sun once, in `once`, and of a soft field that stands for all other scattering. Exact.
vec3 veil(float below, vec3 rd, float t, Medium m, out vec3 once) {
    vec3 fade = m.extinction * (1.0 - rd.y / m.towards.y);   // along the ray, with its sunlight
    once = haze * phaseToSun(rd, m) * m.sun * exp(-m.extinction * below / m.towards.y);
    return once * t * meanFade(fade * t) + 0.22 * haze * fieldLight(m) * exp(-m.diffuse * below)
        * t * meanFade((m.extinction - m.diffuse * rd.y) * t);
}

// Share of the sun that rock leaves to a point.
float besideRock(vec3 p, float blur) {
    vec2 edge = textureLod(shade, p.xz / kTile, 0.0).xy;   // height of the shadow, way to its edge
    return smoothstep(-0.5, 0.5, (p.y - edge.x) / (0.15 + blur * edge.y));
}
// Where light at p came through the surface, m.
vec2 entryOf(vec3 p, Medium m) { return p.xz + m.towards.xz / m.towards.y * (depth - p.y); }

// The net of light, 1 in the mean; w: footprint, m. A second, wider one breaks its repetition.
float netAt(vec3 p, Medium m, float w) {
    vec2 q = entryOf(p, m);
    float lod = log2(max(w / kNet * float(kNetTexels), 1.0));
    float near = textureLod(caustics, q / kNet, lod).x;
    float wide = textureLod(caustics, turn(q, 0.7) / (4.37 * kNet), max(floor(lod - 1.6), 0.0)).x;
    return max(1.0 + netContrast * (near * (0.3 + 0.7 * wide) - 1.0), 0.0);
}

// What shafts and the shadow of rock change along the same ray: a few jittered steps that grow with
// the distance, each exact in its own extinction and in a pattern as fine as it can tell.
vec3 shaftsAlong(vec3 ro, vec3 rd, float t, vec3 once, float jitter, Medium m) {
    float least = min(m.extinction.x, min(m.extinction.y, m.extinction.z)), before = 0.0;
    float reach = min(3.5 / max(least, 1e-3), 120.0), texel = 5.3 * kNet / float(kNetTexels);   // m
    vec3 fade = m.extinction * (1.0 - rd.y / m.towards.y), passed = vec3(0.0), sum = vec3(0.0);
    for (int i = 0; i < shaftSamples && before < t; ++i) {
        float part = float(i + 1) / float(shaftSamples), end = reach * part * sqrt(part);
        float stop = min(end, t), lod = max(floor(log2((end - before) / texel) - 0.9), 0.0);
        vec3 p = ro + mix(before, stop, jitter) * rd, total = stop * meanFade(fade * stop);
        float pattern = textureLod(caustics, turn(entryOf(p, m), -0.4) / (5.3 * kNet), lod).x;
        float deep = mix(0.45, 1.0, clamp(p.y / depth, 0.0, 1.0));   // they blur on their way
        float more = shafts * deep * (pattern - 1.0);   // biased: less than none would be dark
        more = more < 0.0 ? more / (1.0 - more) : more;
        sum += (total - passed) * (besideRock(p, 0.5) * (1.0 + more) - 1.0);
        passed = total;
        before = end;
    }
    return once * sum;
}

// The surface from below: sky through the window, outside it the mirrored deep.
vec3 surfaceLight(vec3 p, vec3 rd, float w, Medium m) {
    float texels = w * inversesqrt(max(rd.y, 0.02)) / kNet * float(kNetTexels);
    float lod = log2(max(texels, 1.0));
    vec4 a = textureLod(surface, p.xz / kNet, lod);
    vec4 b = textureLod(surface, turn(p.xz, 1.1) / (3.3 * kNet), max(floor(lod - 1.2), 0.0));
    vec2 slope = 0.7 * (a.xy + turn(b.xy, -1.1));
    vec3 nor = normalize(vec3(-slope.x, 1.0, -slope.y));
    // Of slopes within the footprint; below a texel what the filter makes up fades away.
    vec2 slopeVariance = max(vec2(a.z - dot(a.xy, a.xy), b.z - dot(b.xy, b.xy)), 0.0)
        * min(square(texels) * vec2(1.0, 1.0 / square(3.3)), 1.0);
    float rough = 0.49 * (slopeVariance.x + slopeVariance.y), cosine = max(dot(rd, nor), 0.02);
    float mirror = fresnel(cosine, 1.0 / kIorWater);
    vec3 through = refract(rd, -nor, kIorWater), back = reflect(rd, nor), once;
    back.y = min(back.y, -0.02);
    vec3 deep = veil(0.0, unit(back), 150.0, m, once);
    return mirror * deep + (1.0 - mirror) * skyColour(through, rough);
}

// ---- Shading ------------------------------------------------------------------------------------
// Ground and wood are matt, in three lights: sun, with the net that the waves draw in it; the field
// from all sides; and the jellyfish. Patterns fade to their mean as the pixel's footprint outgrows
// them.

// Albedo and normal of the floor; w: the pixel's footprint, m, and along the ray.
vec3 floorColour(vec3 p, inout vec3 nor, float w, float grazing) {
    float wide = w * inversesqrt(grazing), lod = floor(log2(max(wide * 4.0, 1.0)) + 0.5);
    vec4 lie = textureLod(relief, p.xz / kTile, lod);
    nor = unit(vec3(-lie.y, 1.0, -lie.z));
    float rock = smoothstep(0.35, 0.65, lie.w + 0.25 * (nor.y < 0.75 ? 1.0 : 0.0));
    // Rock: a grain from above and one from the side; its slope roughens the normal. Whole levels:
    // half the price, and what steps between them is faint.
    float fine = log2(max(wide / 8.0 * 256.0, 1.0)), level = nor.y * nor.y;
    vec4 y = textureLod(grain, p.xz / 8.0, floor(fine + 0.5));
    vec4 x = textureLod(grain, vec2(p.x + 0.4 * p.z, p.y) / vec2(8.0, 5.0), floor(fine + 0.5));
    vec3 slope = mix(vec3(x.zw, 0.4 * x.z), vec3(y.z, 0.0, y.w), level);
    float tone = mix(x.x, y.x, level);
    vec3 stone = mix(vec3(0.07, 0.065, 0.055), vec3(0.40, 0.35, 0.28), tone);
    vec4 large = textureLod(grain, p.xz / 23.0, max(floor(fine - 1.0), 0.0));
    float grown = smoothstep(0.4, 0.7, large.x) * clamp(nor.y, 0.0, 1.0);
    stone = mix(stone, vec3(0.17, 0.21, 0.08), grown);
    // Sand: two trains of ripples that bend with the grain.
    vec2 k1 = vec2(3.0, 9.2), k2 = vec2(9.0, 24.0);   // 1/m
    float bend1 = 9.0 * large.x, bend2 = 5.0 * large.x + 2.0 * y.x, foot = wide * wide;
    float keep1 = exp(-0.06 * dot(k1, k1) * foot), keep2 = exp(-0.06 * dot(k2, k2) * foot);
    float phase = dot(k1, p.xz) + bend1;
    vec2 roll = 0.30 * keep1 * cos(phase) * (1.0 - 0.5 * sin(phase)) * k1 / length(k1)
        + 0.16 * keep2 * cos(dot(k2, p.xz) + bend2) * k2 / length(k2);
    vec3 sand = mix(vec3(0.50, 0.44, 0.34), vec3(0.74, 0.67, 0.53), 0.6 * large.x + 0.4 * y.x)
        * (1.0 + 0.10 * keep1 * sin(phase));
    vec3 sandy = unit(nor - ripples * vec3(roll.x, 0.0, roll.y));
    nor = unit(mix(sandy, unit(nor - 0.7 * slope), rock));
    return mix(sand, stone, rock);
}
// Albedo of wood; q: in the wreck's frame, and bump what roughens the normal there. Weed grows on
// it, and pale crusts where the grain stands high.
vec3 woodColour(vec3 q, int kind, float w, out vec3 bump) {
    vec4 hull = hullSide(q);
    float strake = kind == kPlank ? hull.y * kStrakes : q.z / 0.3;
    float tall = kind == kPlank ? hull.w / kStrakes : 0.3, apart = clamp(1.5 - w / tall, 0.0, 1.0);
    if (kind == kSpar) apart = 0.0;   // round, of one piece
    float seam = overlap(strake - floor(strake + 0.5), w / tall, -0.06, 0.06) * apart;
    float r = random3(ivec3(int(floor(strake)), int(floor(q.x / 2.7)), 9)).x;
    float lod = log2(max(w / 2.0 * 256.0, 1.0));
    vec4 grown = textureLod(grain, vec2(q.x, q.y + q.z) / vec2(5.0, 2.0), floor(lod + 0.5));
    vec4 crust = textureLod(grain, vec2(q.x + 0.4 * q.z, q.y) / vec2(2.6, 1.3), floor(lod + 1.1));
    bump = vec3(grown.z + crust.z, grown.w + crust.w, grown.w - 0.6 * crust.z);
    if (kind == kPlank)   // strakes are worn round: each is light above and dark below
        bump.y -= 2.0 * kLap * apart * (strake - floor(strake) - 0.5);
    vec3 wood = mix(vec3(0.17, 0.115, 0.075), vec3(0.34, 0.26, 0.18), mix(0.5, r, apart));
    wood = mix(wood, vec3(0.20, 0.24, 0.11), smoothstep(0.42, 0.72, grown.x));
    float patches = smoothstep(0.56, 0.74, 0.6 * grown.x + 0.4 * crust.x);
    wood = mix(wood * (0.55 + 0.9 * grown.x), vec3(0.62, 0.58, 0.46), 0.75 * patches);
    return wood * (1.0 - 0.85 * seam);
}

// What the ship and the rock leave at q, in the wreck's frame, of the light: of the sun, and of the
// field, which corners see less of.
vec2 leftOfLight(Layer l, vec3 p, vec3 q, vec3 nor, Medium m) {
    vec3 towards = toWreck(m.towards), shipNor = toWreck(nor);
    vec2 left = vec2(besideRock(p + 0.2 * nor, 0.1), 1.0);
    if (wreck) {
        // Nothing far from her box asks; over the first metre beside it corners fade, or its edge
        // would be seen on the sand.
        float past = max(max(abs(q.x - 0.3) - 12.6, abs(q.z) - 3.4), 0.0), open;   // m
        bool near = past < 1.0 && q.y < 8.0;
        left.x *= besideHull(q, shipNor, towards, 0.12, near, open);
        if (near) left.y = mix(open, 1.0, past);
        if (sailCloth > 0.0 && l.kind <= kTimber)
            left.x *= besideSails(q, towards, 0.1);
    }
    return left;
}
// Light from a surface to the eye.
vec3 layerLight(Layer l, vec3 ro, vec3 rd, float pixel, Medium m) {
    vec3 p = ro + l.t * rd, nor = l.nor, q = toWreck(p - kWreckAt), albedo = vec3(0.0);
    float w = pixel * l.t, through = 0.0;
    bool wooden = l.kind >= kPlank && l.kind <= kSpar;
    if (l.kind == kSand)
        albedo = floorColour(p, nor, w, clamp(-rd.y, 0.04, 1.0));
    if (wooden) {
        vec3 bump;
        albedo = woodColour(q, l.kind, w, bump);
        nor = unit(nor - 0.20 * fromWreck(bump - dot(bump, toWreck(nor)) * toWreck(nor)));
    }
    if (l.kind == kRope) albedo = vec3(0.12, 0.10, 0.07);
    if (l.kind == kSail) albedo = vec3(0.62, 0.58, 0.47);
    if (l.kind == kWeed) albedo = vec3(0.17, 0.18, 0.04);
    if (l.kind >= kSail) through = 0.75;
    vec2 left = leftOfLight(l, p, q, nor, m);
    float below = max(depth - p.y, 0.0), facing = dot(nor, m.towards);
    facing = max(facing, 0.0) + through * max(-facing, 0.0);
    // Slime on wood glows at its outline, where the sun stands behind.
    float edge = wooden ? square(1.0 - min(abs(dot(l.nor, rd)), 1.0)) : 0.0;
    float rim = edge * edge * max(dot(rd, m.towards), 0.0);
    vec3 net = 1.0 + vec3(0.85, 1.0, 1.1) * (netAt(p, m, w) - 1.0);
    vec3 sum = m.sun * exp(-m.extinction * below / m.towards.y) * (facing * left.x)
        * max(net, 0.0);
    vec3 above = unit(vec3(0.0, 1.0, 0.0) + 0.8 * m.towards);   // where the field is strongest
    float spread = wooden ? 0.72 + 0.5 * dot(nor, above) : 0.55 + 0.45 * nor.y;
    sum += left.y * exp(-m.diffuse * below) * fieldLight(m)
        * (max(spread, 0.0) * (1.0 + 0.5 * through) + kRim * rim);
    // The sand throws sunlight back, net and all, at what hangs over it: so the side of the wreck that
    // is turned from the sun is not lost. Biased: as if the wreck shaded none of that sand.
    if (wooden)
        sum += left.y * kSandBack * m.sun * exp(-m.extinction * depth / m.towards.y)
            * (m.towards.y * (0.6 - 0.4 * nor.y) * exp(-max(p.y, 0.0) / kSandReach)) * net;
    // The jellyfish light what is near them.
    float near = 0.0;
    for (int k = 0; k < (jellyLamps ? jellyfish : 0); ++k) {
        vec4 jelly = thing(k, 4);
        vec3 to = jelly.xyz - p;
        float d2 = dot(to, to) + 0.3;
        near += exp(-m.extinction.g * sqrt(d2)) * (1.2 * jelly.w * jelly.w / d2)
            * max(dot(to, nor) * inversesqrt(d2), 0.15);
    }
    return albedo / kPi * (sum + near * jellyGlow * linearColour(jellyColour));
}

// A bell that pulses: its near and its far side, each a skin of glowing water, brighter where the
// ray runs along it (1 / cosine), with ribs, a rim in scallops and a clover of four leaves. f, d:
// the ray where the bell is a unit sphere; t0: where it passes nearest to the middle.
vec3 bellLight(vec3 f, vec3 d, vec3 rd, vec4 jelly, vec2 size, float t0, float pixel, float tMax) {
    vec3 light = vec3(0.0), closest = f + t0 * d;
    float reach2 = dot(d, d), depth2 = 1.0 - dot(closest, closest);
    float w = pixel * max(t0, 0.0), part = w / jelly.w;   // of the bell in a pixel
    for (int j = loopStart() - 1; j < 2; j += 2) {
        float t = t0 + float(j) * sqrt(max(depth2, 0.0) / reach2);
        vec3 q = f + t * d;
        float rim = smoothstep(-0.03 - part, 0.03 + part,
                               q.y + 0.29 + 0.05 * cos(16.0 * atan(q.x, q.z + 1e-6)));
        float skin = 0.14 / max(abs(dot(unit(q / size.xyx), rd)), max(0.1, sqrt(0.5 * part)));
        float a = atan(q.x, q.z + 1e-6), r = length(q.xz);
        float fine = clamp(1.5 - w / (0.2 * jelly.w), 0.0, 1.0);
        float ribs = 1.0 + fine * 0.5 * cos(16.0 * a) * smoothstep(0.15, 0.7, r);
        float leaf = 1.0 - smoothstep(0.0, 0.14, abs(r - 0.36 - 0.10 * cos(4.0 * a)));
        float band = 1.0 - smoothstep(-0.28, 0.0, q.y);
        leaf *= step(0.0, q.y);
        bool shown = depth2 > 0.0 && t > 0.1 && t < tMax;
        if (shown) light += rim * (skin * ribs * vec3(1.0) + 0.5 * leaf * vec3(1.1, 0.7, 1.0)
            + 0.35 * band * vec3(0.9, 1.0, 1.1)) * min(depth2 * jelly.w / max(w, 1e-4), 1.0);
    }
    return light;
}
// Four frilled arms and a fringe of tentacles, as a strip that faces the ray: each hangs where a
// wave that runs down it says, and covers a share of the pixel. u: m aside; s: bells down; wide: a
// pixel, m.
float armsCover(int k, vec4 jelly, float u, float s, float wide, float squeeze) {
    float strands = 0.0;
    for (int j = loopStart(); j < 10; ++j) {
        bool arm = j < 4;
        float place = arm ? 0.16 * (float(j) - 1.5) : 0.28 * (float(j - 4) - 2.5);
        float tall = arm ? 2.6 : 4.6 + 1.1 * sin(2.3 * float(j + k));
        float lag = 2.0 * kPi * (cycles(0.1875) + 0.17 * float(j)) - 1.3 * s;
        float at = jelly.w * (place * (1.0 - 0.3 * squeeze) * (1.0 + 0.12 * s)
            + 0.09 * s * sin(lag));
        float half1 = jelly.w * (arm ? 0.055 * (1.0 + 0.5 * sin(9.0 * s + 2.0 * lag)) : 0.014)
            * clamp(1.2 - s / tall, 0.0, 1.0);
        strands += overlap(u, wide, at - half1, at + half1) * (arm ? 0.5 : 0.6)
            * clamp(1.0 - s / tall, 0.0, 1.0);
    }
    return strands;
}
// Light that the water scatters round all jellyfish, along a ray as far as it is seen in the mean.
// marks: bits of those that the ray may meet themselves. across: level, unit, across the ray.
float halosAlong(vec3 ro, vec3 rd, vec2 across, float tMax, float mean, float dim,
                 out int marks) {
    float halo = 0.0, level2 = dot(rd.xz, rd.xz);
    marks = 0;
    for (int k = 0; k < jellyfish; ++k) {
        vec4 jelly = thing(k, 4);
        vec3 f = jelly.xyz - ro;
        float t = dot(f, rd), away = sqrt(max(dot(f, f) - t * t, 0.0) + square(0.6 * jelly.w));
        vec2 ends = vec2(mean - t, t) / away;   // their arcs, about
        ends *= inversesqrt(1.0 + ends * ends);
        halo += exp(-dim * (max(t, 0.0) + 2.0 * away)) * jelly.w * jelly.w
            * (ends.x + ends.y) / away;
        float side = abs(dot(f.xz, across));
        float low = f.y - rd.y * dot(f.xz, rd.xz) / level2;   // the bell above the ray, m
        bool hangs = side < 1.4 * jelly.w && low > -1.2 * jelly.w && low < 6.5 * jelly.w;
        if ((hangs || away < 1.5 * jelly.w) && t > 0.0 && t < tMax + 2.0) marks |= 1 << k;
    }
    return halo;
}
// Glow of the jellyfish along a ray: bells, arms and tentacles as far as they are seen, and round
// each the light that the water scatters.
vec3 jellyLight(vec3 ro, vec3 rd, float pixel, float tMax, float mean, Medium m) {
    vec3 glow = linearColour(jellyColour) * jellyGlow, sum = vec3(0.0);
    vec3 dim = m.absorption + jellyReach * haze;
    float level2 = dot(rd.xz, rd.xz);
    vec2 across = vec2(rd.z, -rd.x) * inversesqrt(level2);
    int marks;
    float halo = halosAlong(ro, rd, across, tMax, mean, dim.g, marks);
    for (; marks != 0; marks &= marks - 1) {
        int k = lowestBit(marks);
        vec4 jelly = thing(k, 4);
        float beat = 2.0 * kPi * (cycles(0.375 + 0.03125 * float(k % 3)) + kGolden * float(k));
        float squeeze = 0.5 + 0.5 * sin(beat + 0.6 * sin(beat));
        vec2 size = jelly.w * vec2(1.0 - 0.17 * squeeze, 0.62 + 0.13 * squeeze);
        vec3 f = (ro - jelly.xyz) / size.xyx, d = rd / size.xyx;
        float t0 = -dot(f, d) / dot(d, d);
        vec3 light = bellLight(f, d, rd, jelly, size, t0, pixel, tMax);
        float t = -dot(ro.xz - jelly.xz, rd.xz) / level2;
        float u = dot(ro.xz + t * rd.xz - jelly.xz, across), v = jelly.y - ro.y - t * rd.y;
        float s = v / jelly.w;
        float strands = armsCover(k, jelly, u, s, pixel * max(t, 0.0), squeeze);
        if (t > 0.1 && t < tMax && s > 0.1) light += strands * smoothstep(0.1, 0.35, s)
            * vec3(0.9, 0.85, 1.1);
        sum += glow * light * exp(-dim * max(t0, 0.0)) * (0.75 + 0.25 * squeeze)
            * openTo(max(t0, 1e-3), pixel);
    }
    return sum + 0.35 * haze * halo * glow;
}

// Marine snow: one speck in every cell that the ray crosses near the eye, each as bright as the
// share of the pixel that it covers; near ones are out of focus. They sink by whole periods.
float specksAlong(vec3 ro, vec3 rd, float tMax, float pixel) {
    const float reach = 5.6;   // m
    vec3 sink = 32.0 * vec3(cycles(1.0 / 512.0), cycles(1.0 / 256.0), -cycles(1.0 / 1024.0));
    vec3 start = ro / kSpeckCell + sink, inverse = safeInverse(rd), far = step(0.0, rd);
    float sum = 0.0, t = 0.0, end = min(reach, tMax) / kSpeckCell;
    for (int k = 0; k < 14 && t < end; ++k) {
        ivec3 cell = ivec3(floor(start + t * rd + 1e-4 * sign(rd)));
        vec3 r = random3(cell & 31), f = vec3(cell) + 0.15 + 0.7 * r - start;
        float along = dot(f, rd), m = along * kSpeckCell;   // m
        float away2 = max(dot(f, f) - along * along, 0.0) * square(kSpeckCell);
        float size = mix(0.0012, 0.0045, square(fract(7.0 * r.x + 3.0 * r.y)));
        float seen2 = size * size + square(0.5 * pixel * m) + square(0.0035 * max(1.6 - m, 0.0));
        float there = smoothstep(0.25, 0.6, m) * clamp(1.5 - 1.5 * m / reach, 0.0, 1.0);
        if (m < tMax)
            sum += there * exp(-away2 / seen2) * size * size / seen2 * openTo(max(m, 1e-3), pixel);
        vec3 leave = (vec3(cell) + far - start) * inverse;
        t = max(min(leave.x, min(leave.y, leave.z)), t + 1e-3);
    }
    return sum;
}

// ---- Camera -------------------------------------------------------------------------------------
// The eye goes round the wreck, never in it, in the ground or above the water. Then all is put
// together by distance: the water in between, what covers the pixel in part, what lies behind.

Eye camera() {
    bool dragged = iMouse != vec4(0.0);   // the middle of the picture is the camera's own place
    vec2 orbit = dragged ? iMouse.xy / iResolution.xy - 0.5 : vec2(0.0);
    float angle = radians(cameraAngle) - 2.0 * kPi * orbit.x;
    vec2 back = vec2(sin(angle), cos(angle));
    vec2 hull = turn(back, radians(wreckAngle)) / vec2(16.5, 5.2);   // never inside the wreck
    vec2 at = max(cameraDistance, wreck ? inversesqrt(dot(hull, hull)) : 0.0) * back;
    float high = clamp(cameraHeight - 20.0 * orbit.y, 0.3, 38.0);
    Eye e;
    e.pos = vec3(at, min(max(high, groundHeight(at) + 0.7), depth - 0.8)).xzy;
    e.right = vec3(back.y, 0.0, -back.x);
    e.forward = normalize(vec3(0.0, targetHeight, 0.0) + targetShift * e.right - e.pos);
    e.right = unit(cross(e.forward, vec3(0.0, 1.0, 0.0)) + 1e-6 * e.right);
    e.up = cross(e.right, e.forward);
    e.lens = focalLength / 24.0;
    return e;
}

// Light that arrives at ro against rd; pixel: angle of a pixel, rad.
vec3 render(vec3 ro, vec3 rd, float pixel, float jitter) {
    if (dot(rd.xz, rd.xz) < 1e-12) rd.x = 1e-6;   // upright strips face all rays but upright ones
    Medium m = oceanMedium();
    float least = min(m.extinction.x, min(m.extinction.y, m.extinction.z));
    float sight = min(7.0 / max(least, 0.05), 140.0);
    float up = rd.y > 1e-3 ? (depth - ro.y) / rd.y : kFar;
    for (int i = 0; i < kLayers; ++i) layers[i] = Layer(kFar, 0.0, 0, vec3(0.0));
    float t = hitSeabed(ro, rd, pixel, sight);
    Layer solid = Layer(t < 0.0 ? min(up, 200.0) : t, 1.0, t < 0.0 ? 0 : kSand, vec3(0, 1, 0));
    if (wreck) {
        vec3 so = toWreck(ro - kWreckAt), sd = toWreck(rd);
        float s;
        vec3 nor;
        int kind = hitHull(so, sd, pixel, solid.t, s, nor);
        if (kind > 0) solid = Layer(s, 1.0, kind, fromWreck(nor));
        meetRig(so, sd, pixel, solid.t);
        for (int i = 0; i < kLayers; ++i)   // those so far are in the wreck's frame
            layers[i].nor = fromWreck(layers[i].nor);
    }
    meetKelp(ro, rd, pixel, solid.t);
    coverToShare(pixel);
    float mean = openTo(kFar, pixel) * solid.t;   // how far the eye sees, for the water in between
    for (int i = 0; i < kLayers; ++i) mean += layers[i].cover * layers[i].t;
    float snow = specks > 0.0 ? specksAlong(ro, rd, solid.t, pixel) : 0.0;
    vec3 sum = vec3(0.0);
    if (jellyfish > 0 && jellyGlow > 0.0) sum = jellyLight(ro, rd, pixel, solid.t, mean, m);
    float left = 1.0;
    while (left > 0.004 && (solid.kind > 0 || layers[0].t < solid.t)) { //@ allow loop-without-bound
        Layer l = layers[0];
        for (int j = 1; j < kLayers; ++j) layers[j - 1] = layers[j];
        layers[kLayers - 1].t = kFar;
        if (l.t >= solid.t) {
            l = solid;
            l.cover = left;
        }
        sum += l.cover * exp(-m.extinction * l.t) * layerLight(l, ro, rd, pixel, m);
        left -= l.cover;
    }
    if (rd.y > 0.0 && left > 0.004)   // what is left is open water
        sum += left * exp(-m.extinction * solid.t)
            * surfaceLight(ro + up * rd, rd, pixel * min(up, 200.0), m);
    vec3 once, sea = veil(depth - ro.y, rd, mean, m, once);
    sea = max(sea + shaftsAlong(ro, rd, mean, once, jitter, m), 0.0);
    sum += sea;
    return sum + specks * snow * (0.35 * fieldLight(m) * exp(-m.diffuse * (depth - ro.y))
        + 3.0 * once / max(haze, 0.02));
}

// ---- Passes -------------------------------------------------------------------------------------
// Drawn once per look: the floor, what follows from it (slopes, highest points, its shadow), and
// textures. Each frame: where thin things are (most stand still, but one small program for all is
// compiled sooner than three), waves, and the net of light, for which each point of the waves says
// where its light lands, and each texel of the floor asks the points nearby.

void mainGround(out vec4 colour, in vec2 pixel) {
    vec2 p = (pixel / float(kGround) - step(0.5, pixel / float(kGround))) * kTile;
    colour = vec4(floorShape(p), 0.0, 1.0);
}
vec2 groundTexel(ivec2 i) { return texelFetch(ground, i & (kGround - 1), 0).xy; }
// Height, slopes, share of rock.
void mainRelief(out vec4 colour, in vec2 pixel) {
    ivec2 i = ivec2(pixel), e = ivec2(1, 0);
    vec2 rise = vec2(groundTexel(i + e.xy).x - groundTexel(i - e.xy).x,
                     groundTexel(i + e.yx).x - groundTexel(i - e.yx).x);
    vec2 here = groundTexel(i);
    colour = vec4(here.x, rise * (0.5 * float(kGround) / kTile), here.y);
}
vec2 groundSlope(ivec2 i) {   // eastward between i and its neighbour, northward likewise
    return (vec2(groundTexel(i + ivec2(1, 0)).x, groundTexel(i + ivec2(0, 1)).x)
        - groundTexel(i).x) * (float(kGround) / kTile);
}
// Of what the filter makes of a cell's texels: highest point, and the disc in which all slopes lie.
void mainTops(out vec4 colour, in vec2 pixel) {
    int side = int(kCell / kTile * float(kGround)) + 2;
    ivec2 first = ivec2(pixel) * (side - 2) - 1;
    vec2 least = vec2(kFar), most = vec2(-kFar);
    float top = -kFar;
    for (int k = 0; k < side * side; ++k) {
        ivec2 i = first + ivec2(k % side, k / side);
        vec2 slope = groundSlope(i);
        top = max(top, groundTexel(i).x);
        least = min(least, slope);
        most = max(most, slope);
    }
    colour = vec4(top, 0.5 * (least + most), 0.5 * length(most - least));
}
void mainSummits(out vec4 colour, in vec2 pixel) {
    colour = vec4(-kFar);
    for (int k = 0; k < 16; ++k)
        colour = max(colour, texelFetch(tops, ivec2(pixel) * 4 + ivec2(k & 3, k >> 2), 0));
}
// Height below which rock stands before the sun, and the way to its edge.
void mainShade(out vec4 colour, in vec2 pixel) {
    vec2 p = pixel / 256.0 * kTile, edge = vec2(-kFar, 1.0);
    vec3 towards = oceanMedium().towards;
    vec2 lean = towards.xz / towards.y;
    for (int k = 1; k <= 64; ++k) {
        float s = 0.012 * float(k * k) + 0.2 * float(k), top = groundHeight(p + lean * s) - s;
        if (top > edge.x) edge = vec2(top, s);
    }
    colour = vec4(edge, 0.0, 1.0);
}
float grainHeight(vec2 u) {   // 0 to 1, on a torus
    float sum = 0.0, gain = 0.55;
    for (int k = 0; k < 5; ++k) {
        int period = 4 << k;
        vec2 q = u * float(period), c = floor(q);
        sum += gain * seabedNoise(ivec2(c), q - c, period, 40 + k);
        gain *= 0.55;
    }
    return clamp(0.5 + 0.85 * sum, 0.0, 1.0);
}
// Height, its square, slopes a tile: the height here and to both sides of it, along x and y.
void mainGrain(out vec4 colour, in vec2 pixel) {
    vec2 rise = vec2(0.0);
    for (int k = 0; k < 5; ++k) {
        float way = float(k & 1) * 2.0 - 1.0;
        vec2 aside = k == 0 ? vec2(0.0) : k < 3 ? vec2(way, 0.0) : vec2(0.0, way);
        float height = grainHeight((pixel + aside) / 256.0);
        if (k == 0) colour = vec4(height, height * height, 0.0, 0.0);
        rise += aside * height;
    }
    colour.zw = rise * 128.0;
}
// An end of a spar or a rope, the first or the second, with its radius.
vec4 ropeEnd(int k, int end) {
    readWreck();
    // Foremast, mainmast, stump of the mizzen, bowsprit, four yards, a fallen yard, a fallen spar.
    const vec4 from[kSpars] = vec4[kSpars](
        vec4(5.6, 0.4, 0.0, 0.24), vec4(-0.8, 0.4, 0.0, 0.28), vec4(-7.4, 0.6, 0.0, 0.22),
        vec4(9.6, 5.0, 0.0, 0.20), vec4(kYardFrom[0].xyz, 0.10), vec4(kYardFrom[1].xyz, 0.07),
        vec4(kYardFrom[2].xyz, 0.11), vec4(kYardFrom[3].xyz, 0.08), vec4(-4.6, 5.3, -3.9, 0.10),
        vec4(2.9, 1.0, -5.6, 0.12));
    const vec4 to[kSpars] = vec4[kSpars](
        vec4(5.3, 16.8, 0.0, 0.09), vec4(-1.3, 19.0, 0.0, 0.10), vec4(-7.7, 9.3, 0.2, 0.19),
        vec4(15.6, 7.6, 0.0, 0.09), vec4(kYardTo[0].xyz, 0.10), vec4(kYardTo[1].xyz, 0.07),
        vec4(kYardTo[2].xyz, 0.11), vec4(kYardTo[3].xyz, 0.08), vec4(-2.0, 3.0, 4.2, 0.10),
        vec4(-3.2, 0.9, -4.7, 0.08));
    vec4 a = vec4(0.0), b = vec4(0.0);
    if (k < kSpars) {
        a = from[k];
        b = to[k];
    }
    int rope = k - kSpars, stay = rope - kShrouds;
    if (rope >= 0 && rope < kShrouds) {
        bool fore = rope < 6;
        float lane = float(rope / 2 % 3) - 1.0, side = float(rope % 2) * 2.0 - 1.0;
        a = vec4(fore ? 5.4 : -1.1, fore ? 12.6 : 14.4, 0.05 * side, 0.018);
        b = vec4((fore ? 5.0 : -1.6) + 0.75 * lane, 4.5, 2.75 * side, 0.022);
        if (!fore && side < 0.0)   // where the side is gone they hang
            b.xyz = a.xyz + (6.3 + 1.2 * lane) * toWreck(vec3(0.1 * lane, -1.0, 0.0));
    }
    if (stay >= 0 && stay < kStays) {
        a = stay < 2 ? vec4(15.2, 7.4, 0.0, 0.022) : stay == 2 ? vec4(5.3, 16.4, 0.0, 0.02)
            : stay == 3 ? vec4(-1.3, 18.4, 0.0, 0.02) : vec4(2.8, 9.2, 3.0, 0.014);
        b = stay == 0 ? vec4(5.35, 16.4, 0.0, 0.02) : stay == 1 ? vec4(5.45, 9.0, 0.0, 0.02)
            : stay == 2 ? vec4(-1.1, 13.6, 0.0, 0.02) : stay == 3 ? vec4(-7.7, 9.1, 0.2, 0.02)
            : vec4(3.0, 5.4, 3.6, 0.014);
    }
    return end == 0 ? a : b;
}
vec4 plantAt(int k) {   // its foot and its height; they stand in groups of five
    int group = k / 5;
    vec3 r = random3(ivec3(k, 21, 4)), g = random3(ivec3(group, 22, 4));
    float a = 2.0 * kPi * (kGolden * float(group) + 0.13), away = mix(13.0, 36.0, g.x);
    vec2 at = away * vec2(sin(a), cos(a));
    if (group == 0) at = vec2(-3.6, 12.6);
    if (group == 1) at = vec2(15.5, 3.0);
    vec2 hull = turn(at, radians(wreckAngle)) / vec2(17.0, 9.0);
    at *= max(1.0, inversesqrt(max(dot(hull, hull), 1e-3)));
    at += (1.2 + 0.05 * away) * (2.0 * r.xy - 1.0);
    float foot = groundHeight(at) - 0.1, tall = kelpHeight * mix(0.5, 1.25, r.z);
    return vec4(at.x, foot, at.y, clamp(tall, 0.5, max(depth - 1.5 - foot, 0.5)));
}
// A plant, or of a group its middle, its top and its radius.
vec4 kelpAt(int k, bool group) {
    vec3 lo = vec3(kFar), hi = vec3(-kFar);
    vec4 plant = vec4(0.0);
    float reach = 0.0;
    for (int j = 0; j < (group ? 5 : 1); ++j) {
        plant = plantAt(group ? 5 * k + j : k);
        lo = min(lo, plant.xyz);
        hi = max(hi, vec3(plant.x, plant.y + plant.w, plant.z));
        reach = max(reach, 0.2 * plant.w);   // how far it swings
    }
    vec3 mid = 0.5 * (lo + hi);
    return group ? vec4(mid.x, hi.y, mid.z, 0.5 * length((hi - lo).xz) + reach) : plant;
}
// The middle of each bell and its radius: slow rounds about a place of its own beside the wreck.
vec4 jellyAt(int k) {
    vec3 r = random3(ivec3(k, 31, 6));
    float a = 2.0 * kPi * (kGolden * float(k) + 0.06);
    vec2 at = vec2(sin(a), cos(a)), hull = turn(at, radians(wreckAngle)) / vec2(17.5, 9.0);
    at *= max(inversesqrt(dot(hull, hull)), 8.5) + 3.0 * r.x;
    vec3 now = 2.0 * kPi * (r + vec3(cycles(0.0078125), cycles(0.015625), cycles(0.01171875)));
    vec3 p = vec3(at.x, mix(6.0, 14.0, fract(kGolden * float(3 * k) + 0.3)), at.y)
        + vec3(1.4 * sin(now.x), 0.8 * sin(now.y), 1.4 * cos(now.z));
    float size = mix(0.38, 0.85, r.z);
    p.y = clamp(p.y, groundHeight(p.xz) + 3.0, depth - 2.0);
    return vec4(p, size);
}
// Rows 0 and 1: ends of spars and ropes. 2: plants. 3: groups of them. 4: jellyfish.
void mainThings(out vec4 colour, in vec2 pixel) {
    int k = int(pixel.x), row = int(pixel.y);
    colour = row < 2 ? ropeEnd(k, row) : row < 4 ? kelpAt(k, row == 3) : jellyAt(k);
}

// Whole waves in the tile along x and z, and slope, relative; whole cycles in a loop.
vec4 netWave(int i) {
    float share = float(i) / float(kWaves - 1), a = 2.0 * kPi * kGolden * float(i);
    vec2 n = floor(mix(3.5, 8.5, share) * vec2(cos(a), sin(a)) + 0.5);
    float hz = sqrt(kGravity * 2.0 * kPi / kNet * length(n)) / (2.0 * kPi);
    float slow = 0.35;   // the surface's waves that focus this deep are longer than the net's
    return vec4(n, 1.0, max(floor(slow * hz * loopSeconds + 0.5), 1.0));
}
// The waves: slopes and their square; where light from a point of the tile lands, in texels from
// it (two numbers of 12 bits in one), and the Gaussian that it makes d texels from there, det W
// exp2(-|W d|^2): W, upper triangular, xx, xz and zz. J, the derivative of where light lands, takes
// the step to a neighbour, 1 texel, to how far apart both land: so a round Gaussian of deviation
// 0.6 texels at the surface, which overlaps its neighbours' evenly, has the covariance 0.36 J J^T on
// the floor, and no gaps open however light spreads.
void mainSurface(out vec4 slopes, out vec4 landing, in vec2 pixel) {
    vec2 u = pixel / float(kNetTexels), slope = vec2(0.0);
    vec3 curve = vec3(0.0);   // xx, xz, zz
    float now = cycles(1.0 / loopSeconds), bent = 0.0;
    for (int i = 0; i < kWaves; ++i) {
        vec4 wave = netWave(i);
        float phase = fract(dot(wave.xy, u) - wave.w * now) + fract(kGolden * float(i * i));
        vec2 k = 2.0 * kPi / kNet * wave.xy;                 // 1/m
        float a = wave.z * sqrt(2.0 / float(kWaves)) / max(length(k), 1e-3);
        slope += a * cos(2.0 * kPi * phase) * k;
        curve -= a * sin(2.0 * kPi * phase) * vec3(k.x * k.x, k.x * k.y, k.y * k.y);
        bent += 0.5 * square(a * dot(k, k));
    }
    slopes = vec4(waveSlope * slope, square(waveSlope) * dot(slope, slope), 1.0);
    float fall = 0.85 * netSharpness * inversesqrt(bent);    // m
    vec2 aside = -fall * float(kNetTexels) / kNet * slope;   // texels
    aside *= min(1.0, 5.5 * inversesqrt(max(dot(aside, aside), 1e-6)));
    aside = floor(aside * kSplatSteps + 2048.5);
    mat2 j = mat2(1.0 - fall * curve.x, -fall * curve.y, -fall * curve.y, 1.0 - fall * curve.z);
    mat2 wide = 0.36 * j * transpose(j) + mat2(0.34);        // the sun's disc blurs by the latter
    float size = max(determinant(wide), 1e-4);
    vec2 w = vec2(sqrt(wide[1][1] / size), -wide[0][1] * inversesqrt(size * wide[1][1]));
    landing = vec4(aside.x + 4096.0 * aside.y, kOctaves * vec3(w, inversesqrt(wide[1][1])));
}
// Light on a square of four texels of the net, in rows: most of the time goes into reading what may
// land there, and that is read once for all four.
void mainGathered(out vec4 colour, in vec2 pixel) {
    vec4 sum = vec4(0.0);
    vec2 first = 2.0 * pixel - 0.5;
    for (int z = -kReach; z <= kReach + 1; ++z) {   // a disc: corners are out of reach
        int away = z > 0 ? z - 1 : z;
        int wide = int(sqrt(square(float(kReach) + 1.0) - float(away * away) - 0.5));
        for (int x = -wide; x <= wide + 1; ++x) {
            vec4 s = textureLod(splat, (first + vec2(x, z)) / float(kNetTexels), 0.0);
            float row = floor(s.x / 4096.0);
            vec2 d = vec2(x, z) + (vec2(s.x - 4096.0 * row, row) - 2048.0) / kSplatSteps;
            float u = s.y * d.x + s.z * d.y, v = s.w * d.y;
            vec4 across = u - vec4(0.0, s.y, s.z, s.y + s.z), down = v - vec4(0.0, 0.0, s.w, s.w);
            sum += s.y * s.w * exp2(-across * across - down * down);
        }
    }
    colour = sum / (2.0 * kPi * kOctaves * kOctaves);
}
void mainCaustics(out vec4 colour, in vec2 pixel) {
    ivec2 at = ivec2(pixel);
    colour = vec4(texelFetch(gathered, at / 2, 0)[(at.x & 1) + 2 * (at.y & 1)]);
}

// ---- Image --------------------------------------------------------------------------------------
// A pixel's noise moves the samples of the shafts; it is the finest grain, which the eye averages.
// Half a step of dither, of the 255 that a display has, hides the bands of dark water: the same for
// all samples of a pixel, whose mean is rounded, for the mean of many would be none.

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
    readWreck();
    Eye e = camera();
    vec3 sum = vec3(0.0), chance = random3(ivec3(16 * ivec2(fragCoord) + 8, 5));
    float order = shuffledQuarters(ivec2(fragCoord));
    for (int k = 0; k < antialias; ++k) {   // an R2 sequence over the pixel
        vec2 at = fragCoord;
        if (antialias > 1) at += fract(0.5 + float(k) * vec2(0.7548777, 0.5698403)) - 0.5;
        vec2 uv = (at - 0.5 * iResolution.xy) / iResolution.y;
        vec3 rd = normalize(uv.x * e.right + uv.y * e.up + e.lens * e.forward);
        float jitter = fract(order + at.x);   // evenly apart among the samples of a pixel, too
        float falloff = square(dot(rd, e.forward));   // half of a simple lens's cos^4
        vec3 light = render(e.pos, rd, 1.0 / (e.lens * iResolution.y), jitter);
        sum += falloff * light / float(antialias);
    }
    vec3 dither = (chance + chance.yzx - 1.0) * (0.5 / 255.0);
    fragColor = vec4(display(exp2(exposure) * sum) + dither, 1.0);
}
