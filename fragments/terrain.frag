// A block of land: mountains, woods and a lake, cut out of the world like a piece of cake.
//
// Snow over rock over green, trees, and a lake so clear that one sees its bed, with closed sides
// and a bottom, afloat above the clouds. It holds together from every side, from below and through
// the water. The lake finds what it mirrors by walking the picture's own depth, and exactly where
// that does not tell for certain, or everywhere, for comparison.
//
// Method   Land is a height at 513 x 513 nodes, drawn once, bilinear between them; a pyramid of
//          greatest heights lets a ray jump over what it cannot touch, and the patch that it meets
//          is solved as a quadratic, so no step can be too long and no edge leaks. Shadows and the
//          open part of the sky are drawn once too. Waves are gradient noise whose third axis is
//          time and closes after 64 cells. Their slopes and the products of these are averaged by
//          mipmaps: what a pixel cannot show widens the cone in which clouds are mirrored, and what
//          its parts cannot, the sun's lobe in each: glitter that is 0.1 to 0.37 of its mean off.
//          Light in the water is followed through all of its faces, with absorption and scattering
//          in closed form.
// Sources  Perlin, SIGGRAPH (2002): noise. Jarzynski and Olano, JCGT 9(3) (2020): pcg3d. Tevs,
//          Ihrke, Seidel, I3D (2008): maximum mipmaps. McGuire and Mara, JCGT 3(4) (2014): rays in
//          the picture. Olano and Baker, I3D (2010): mean products of slopes. Ross, Dion, Potvin,
//          JOSA A 22 (2005), and Bruneton, Neyret, Holzschuch, CGF 29 (2010): glitter. Nishita et
//          al., SIGGRAPH (1993): sky. Born and Wolf, Principles of Optics, 1.5: Fresnel. Vogel
//          (1979): phyllotaxis. Abramowitz and Stegun (1964), 25.4.40: quadrature. Potmesil and
//          Chakravarty, SIGGRAPH (1981): circles of confusion.
// Units    1 unit = 1 m, y up, linear colour; the sun gives kSunPower above the air.
// Passes   tile + cloudTile, bare, land, peaks, sky, ambient, lightMap: on change of a tweak. Every
//          frame: waves, gathered, colours + normalDepth; picture where `tiltShift` blurs it.
// Bounds   Biased: waves tilt the water and do not move it; light that leaves the water meets the
//          sky, and land where reflections are traced, but never water again. The loops of a pixel
//          stay below 30,000 turns with every reference on.
// Defaults From `glint study presets/terrain.toml`: reflections in the picture are 0.007 (RMSE)
//          from traced ones, which take no longer (llvmpipe), none 0.03. 35 reflectionSteps keep a
//          ray in the picture at 32 reads. The pyramid is 0.005 from the many-step march in less
//          than half of its frame; 160 marchSteps leave no more than 0.1 % of the rays out of steps
//          over any land.
// Licence  MIT

// ---- Tweaks -------------------------------------------------------------------------------------
//@ group Land
uniform int   landscape;       //@ 0 [0, 999] "another land; 0 is laid out by hand"
uniform float relief;          //@ 1.0 [0, 1.6] "heights and depths, times this"
uniform float ruggedness;      //@ 1.0 [0, 2] "ridges and gullies"
uniform float trees;           //@ 0.6 [0, 1] "share of the green that is woods"
uniform float rockLine;        //@ 12 [-5, 60] unit=m "where meadows end"
uniform float snowLine;        //@ 19 [-5, 80] unit=m "where snow begins"
uniform vec3  grassColour;     //@ #6f9a44 "of meadows"
uniform vec3  rockColour;      //@ #a48563 "of cliffs"
//@ group Water
uniform float waterLevel;      //@ 0 [-16, 12] unit=m "of the lake"
uniform float waveHeight;      //@ 0.2 [0, 1.5] unit=m "of the longest waves"
uniform float waveLength;      //@ 4.0 [2, 24] log unit=m "of the noise of the longest waves"
uniform vec3  waterTint;       //@ #49b3c2 "what 10 m of water leave of white light"
uniform float murk;            //@ 0.35 [0, 2] "share of what is lost that comes back scattered"
uniform float caustics;        //@ 0.7 [0, 1] "light that waves gather on the bed"
uniform float animation;       //@ 1.0 [0, 4] "speed of everything that moves"
//@ group Sky
uniform float sunHeight;       //@ 30 [1, 85] unit=deg "over the horizon"
uniform float sunAngle;        //@ -100 [-180, 180] unit=deg "0 is straight ahead of the camera's 0"
uniform float sunSize;         //@ 0.8 [0.1, 3] log unit=deg "radius of the sun's disc"
uniform float haze;           //@ 0.35 [0.1, 6] log "dust and moisture in the air"
uniform float clouds;          //@ 0.5 [0, 1] "share of the sky that they cover"
//@ group Camera
uniform float cameraDistance;  //@ 250 [20, 600] log unit=m "from the target, outside of the block"
uniform float cameraAngle;     //@ 33 [-180, 180] unit=deg "round it"
uniform float cameraRise;      //@ 24 [-88, 88] unit=deg "over it; close by it jumps past the block"
uniform vec3  target;          //@ 0, -3, 0 [-50, 50] unit=m "the point looked at"
uniform float focalLength;     //@ 50 [12, 200] log unit=mm "of a lens on 36 x 24 mm film"
uniform float tiltShift;       //@ 0.0 [0, 0.05] "blur of what is far off, in picture heights"
uniform float exposure;        //@ 0.0 [-4, 4] unit=stop "before the display curve"
//@ group Quality
uniform int   reflections;     //@ 2 {off, screen-space, traced} quality reference=2 "of the land"
uniform int   border;          //@ 0 {stretch, fade} "what a ray finds that leaves the picture"
uniform int   reflectionSteps; //@ 35 [4, 1024] log quality reference=1024 "of a ray in the picture"
uniform int   march;           //@ 0 {pyramid, steps} quality reference=1 second=pyramid "of rays to land"
uniform int   marchSteps;      //@ 160 [32, 512] log quality reference=512 "most for one ray to land"
uniform int   bends;           //@ 3 [1, 8] quality reference=8 "faces that light in water meets"
uniform int   shadowSamples;   //@ 3 [1, 64] log quality reference=64 "columns of the sun's disc"
uniform int   glitterSamples;  //@ 16 [1, 64] log quality reference=64 "of the waves in one pixel"
uniform int   lensSamples;     //@ 32 [8, 256] log quality reference=256 "taps of a blur"

precision highp sampler2D;     // the default is lowp: Mesa then reads 32-bit buffers as halves
uniform sampler2D tile;        //@ pass mainTile size=512x512 format=rgba16f filter=mipmap wrap=repeat
uniform sampler2D cloudTile;   //@ pass mainTile size=512x512 format=rgba16f filter=mipmap wrap=repeat
uniform sampler2D bare;        //@ pass mainBare size=513x513
uniform sampler2D land;        //@ pass mainLand size=513x513
uniform sampler2D peaks;       //@ pass mainPeaks size=640x512 filter=nearest
uniform sampler2D sky;         //@ pass mainSky size=256x128 format=rgba16f
uniform sampler2D ambient;     //@ pass mainAmbient size=8x1 filter=nearest
uniform sampler2D lightMap;    //@ pass mainLightMap size=513x513 format=rgba16f
uniform sampler2D waves;       //@ pass mainWaves size=512x512 filter=mipmap
uniform sampler2D gathered;    //@ pass mainGathered size=256x256 format=r32f
uniform sampler2D colours;     //@ pass mainGBuffer filter=nearest
uniform sampler2D normalDepth; //@ pass mainGBuffer filter=nearest
uniform sampler2D picture;     //@ pass mainPicture filter=nearest
uniform sampler2D softPicture; //@ buffer picture filter=mipmap

// ---- Constants and numbers ----------------------------------------------------------------------
// The block is 2 kHalf wide and stands round the origin; y = 0 is near the lake's usual level. All
// that chance decides is drawn from hashes of whole numbers, so that a land has a number.

const float kPi = 3.14159265358979;
const float kGolden = 0.61803398874989;    // turns between neighbours of a phyllotaxis
const float kFar = 1e9;                    // m, a miss
const float kIorWater = 1.333;             // visible light, 20 C
const vec3  kSunPower = vec3(20.0);        // above the air, on a surface that faces it
const float kCalmSpread = 0.0008;          // slope variance of capillary waves, always unresolved
const float kEarth = 6.36e6, kAir = 6e4;   // m, radius and height of the air
const vec3  kRayleigh = vec3(5.8e-6, 13.5e-6, 33.1e-6);   // 1/m at sea level
const vec3  kOzone = vec3(0.65e-6, 1.88e-6, 0.085e-6);    // 1/m at 25 km
const float kMie = 4e-6;                   // 1/m at sea level and haze 1
const float kNear = 0.05;                  // m, depth of the near plane of screen-space rays
const float kHalf = 50.0;                  // m, of the block's sides
const float kBase = -24.0;                 // m, its bottom
const float kBed = -19.0;                  // m, no land is lower
const float kSummit = 40.0;                // m, nor higher at relief 1
const int   kCells = 512;                  // patches along a side
const float kPerCell = 5.12;               // cells in a metre
const vec2  kPeaks = vec2(640.0, 512.0);   // texels of the pyramid
const int   kSunRows = 8;                  // rays to a column of the sun's disc
const float kTreeGap = 1.9;                // m
const int   kWaveCells = 64;               // of time, after which waves begin again
const int   kSky = 0, kLand = 1, kWall = 2, kBottom = 3, kWater = 4, kSide = 5;
// Hills of the land that is laid out by hand: place in half sides, height in m, radius. The first
// two are peaks.
const vec4 kHills[8] = vec4[8](
    vec4(-0.50, -0.46, 28.0, 0.74), vec4(0.08, -0.90, 20.0, 0.54), vec4(-1.02, 0.60, 20.0, 0.50),
    vec4(1.04, 0.38, 22.0, 0.54), vec4(0.76, -0.84, 18.0, 0.42), vec4(0.20, -0.02, 14.5, 0.20),
    vec4(-0.42, 1.12, 18.0, 0.40), vec4(-0.95, -0.95, 17.0, 0.50));

struct Hit { float t; int id; vec3 nor; };
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
// Reflected share of unpolarised light, exact; eta: index beyond over index before the surface.
float fresnel(float cosI, float eta) {
    float gg = (eta - 1.0) * (eta + 1.0) + cosI * cosI;
    if (gg <= 0.0) return 1.0;
    float g = sqrt(gg);
    float a = (g - cosI) / max(g + cosI, 1e-9);
    float b = (cosI * (g + cosI) - 1.0) / (cosI * (g - cosI) + 1.0);
    return min(0.5 * a * a * (1.0 + b * b), 1.0);
}
// The direction behind a surface; eta: index before over index beyond. Where nothing gets through,
// along the surface: fresnel() is 1 there.
vec3 refractExactly(vec3 rd, vec3 nor, float eta) {
    float cosine = clamp(-dot(rd, nor), 0.0, 1.0), sine = eta * length(cross(rd, nor));
    // 1 - sine^2, of what is small: near the critical angle of a dense glass the cosine, near 1, has
    // lost the digits that decide.
    float k = cosine < 0.7 ? (1.0 - eta) * (1.0 + eta) + square(eta * cosine)
        : (1.0 - sine) * (1.0 + sine);
    return unit(eta * rd + (eta * cosine - sqrt(max(k, 0.0))) * nor);
}
vec3 safeInverse(vec3 rd) {   // never infinite, so a slab never multiplies 0 by infinity
    return 1.0 / mix(rd, vec3(1e-20), lessThan(abs(rd), vec3(1e-20)));
}
vec3 sunDirection() {
    float a = radians(sunAngle), h = radians(sunHeight);
    return vec3(sin(a) * cos(h), sin(h), -cos(a) * cos(h));
}

// Gradient noise and its gradient: vec4(gradient, value), |value| <= 1.5. cell and f: the point's
// lattice cell and its place in it, so that no digit is lost far out; wrap: bits of the lattice's
// numbers that count, -1 for all.
vec4 perlinIn(ivec3 cell, vec3 f, ivec3 wrap) {
    vec3 s = f * f * f * (f * (f * 6.0 - 15.0) + 10.0), ds = 30.0 * f * f * (f * (f - 2.0) + 1.0);
    vec4 sum = vec4(0.0);
    for (int k = 0; k < 8; ++k) {
        ivec3 o = ivec3(k & 1, (k >> 1) & 1, k >> 2);
        vec3 g = 2.0 * random3((cell + o) & wrap) - 1.0;
        float d = dot(g, f - vec3(o));
        vec3 w = mix(1.0 - s, s, vec3(o)), dw = ds * (2.0 * vec3(o) - 1.0);
        vec3 steep = vec3(dw.x * w.y * w.z, w.x * dw.y * w.z, w.x * w.y * dw.z);
        sum += vec4(w.x * w.y * w.z * g + d * steep, w.x * w.y * w.z * d);
    }
    return sum;
}
// The same in a plane of the lattice: vec3(gradient, value).
vec3 perlinPlane(vec2 p, int plane, int wrap) {
    vec2 c = floor(p);
    return perlinIn(ivec3(ivec2(c), plane), vec3(p - c, 0.0), ivec3(wrap, wrap, -1)).xyw;
}

// ---- Land ---------------------------------------------------------------------------------------
// A height over (x, z): eight hills of the form exp(-r), bent so that none is round, and six
// octaves of gradient noise, each with half the width and half the height of the one before; low
// land has the noise itself, high land its ridges, -|n|. Drawn once into a buffer, it is from then
// on bilinear between nodes: along a ray such a patch is a quadratic in t, so that a hit is solved
// and not sought. A pyramid holds the greatest height of ever larger squares: a ray above that
// jumps over the square.

float landTop() { return max(texelFetch(ambient, ivec2(7, 0), 0).x, waterLevel) + 0.1; }
vec2 landUv(vec2 p) { return ((p + kHalf) * kPerCell + 0.5) / float(kCells + 1); }

// Height without trees, and its slope: vec3(d/dx, d/dz, height).
vec3 bareLand(vec2 p) {
    int plane = 64 * landscape;
    // Bent a little, so that no hill is round.
    vec3 bx = perlinPlane(p / 31.0, plane + 1, -1) * 11.0;
    vec3 bz = perlinPlane(p / 31.0, plane + 2, -1) * 11.0;
    vec2 q = p + vec2(bx.z, bz.z);
    vec2 acrossX = vec2(1.0 + bx.x / 31.0, bz.x / 31.0);
    vec2 acrossZ = vec2(bx.y / 31.0, 1.0 + bz.y / 31.0);
    vec3 hills = vec3(0.0, 0.0, -12.5);
    for (int k = 0; k < 8; ++k) {
        vec3 chance = random3(ivec3(k, landscape, 9));
        vec4 hill = kHills[k];
        if (landscape > 0) hill.xy = 2.2 * chance.xy - 1.1;
        vec2 d = (q / kHalf - hill.xy) / hill.w;
        float blunt = k < 2 ? 0.17 : 0.5, r = sqrt(dot(d, d) + blunt * blunt);
        float e = hill.z * exp(2.1 * (blunt - r));
        hills += vec3(e * -2.1 / (r * hill.w * kHalf) * d, e);
    }
    hills.xy = vec2(dot(hills.xy, acrossX), dot(hills.xy, acrossZ));
    // Rounded below, with ridges above.
    vec3 smoothed = vec3(0.0), ridged = vec3(0.0);
    float lattice = 31.0, gain = 1.0;
    for (int k = 0; k < 6; ++k) {
        vec3 n = perlinPlane(turn(p, 0.6 * float(k)) / lattice, plane + 8 + k, -1);
        n.xy = turn(n.xy, -0.6 * float(k)) / lattice;
        float fold = sqrt(n.z * n.z + 0.0025);
        smoothed += gain * n;
        ridged += gain * vec3(-n.z / fold * n.xy, 0.22 - fold);
        lattice *= 0.5;
        gain *= 0.5;
    }
    float up = clamp((hills.z + 1.0) / 17.0, 0.0, 1.0), share = up * up * (3.0 - 2.0 * up);
    vec2 dShare = 6.0 * up * (1.0 - up) / 17.0 * hills.xy;
    vec3 rough = mix(7.0 * smoothed, 34.0 * ridged, share);
    rough.xy += (34.0 * ridged.z - 7.0 * smoothed.z) * dShare;
    vec3 sum = hills + ruggedness * rough;
    // Beaches: flatter near the lake's usual level.
    float x = sum.z / 1.5, beach = 0.62 * exp(-min(x * x, 60.0));
    sum = vec3(sum.xy * (1.0 - beach * (1.0 - 2.0 * x * x)), sum.z * (1.0 - beach));
    sum *= relief;
    if (sum.z < kBed) sum = vec3(0.0, 0.0, kBed);
    if (sum.z > relief * kSummit) sum = vec3(0.0, 0.0, relief * kSummit);
    return sum;
}

// Height of the surface as rays see it: bilinear between the nodes.
float landHeight(vec2 p) {
    vec2 g = clamp((p + kHalf) * kPerCell, 0.0, float(kCells));
    vec2 c = min(floor(g), float(kCells - 1)), u = g - c;
    vec4 h = fetch(peaks, c, kPeaks);
    return h.x + (h.y - h.x) * u.x + (h.z - h.x) * u.y + (h.x - h.y - h.z + h.w) * u.x * u.y;
}

int landTurns = 0;   // texels that a ray to land has read, for measurements
// Where a ray that is above land at t0 meets it before t1, or kFar. Cells of four sizes: over one
// that the ray passes above, it jumps; a smallest one is a patch, met where a quadratic is 0. What
// begins below the surface, by a rounding, meets it at once: nothing leaks.
float hitLand(vec3 ro, vec3 rd, float t0, float t1) {
    landTurns = 0;
    vec3 p = ro + t0 * rd;
    vec2 o = clamp((p.xz + kHalf) * kPerCell, 0.0, float(kCells)), d = rd.xz * kPerCell;
    d = mix(d, vec2(1e-9), lessThan(abs(d), vec2(1e-9)));
    vec2 ahead = step(0.0, d), inverse = 1.0 / d, nudge = sign(d) * 2e-3;   // cells
    float s = 0.0, end = t1 - t0, met = kFar;
    int level = 3;
    bool open = s < end;
    for (int k = 0; k < marchSteps && open; ++k) {
        int shift = 2 * level;
        vec2 g = o + s * d;
        ivec2 c = clamp(ivec2(g + nudge), 0, kCells - 1) >> shift;
        vec2 edge = (vec2(c) + ahead) * float(1 << shift), sides = (edge - o) * inverse;
        sides = mix(sides, vec2(kFar), equal(edge, ahead * float(kCells)));   // t1 ends the ray
        float leave = min(max(min(sides.x, sides.y), s + 1e-5), end);
        ivec2 shelf = ivec2(level > 0 ? kCells : 0, level == 2 ? 128 : level == 3 ? 160 : 0);
        vec4 h = fetch(peaks, vec2(shelf + c), kPeaks);
        ++landTurns;
        float top = max(max(h.x, h.y), max(h.z, h.w)), y = p.y + s * rd.y;
        if (min(y, p.y + leave * rd.y) > top) {
            s = leave;
            ivec2 next = clamp(ivec2(o + s * d + nudge), 0, kCells - 1);
            // Out of the square of the next level, too: that one may be jumped again.
            if ((next >> (shift + 2)) != (c >> 2)) level = min(level + 1, 3);
        } else if (level > 0) {
            --level;
            if (rd.y < 0.0) s = clamp((top - p.y) / rd.y, s, leave);
        } else {
            // Ray less land along it is f0 + f1 s + f2 s^2. Its first root ahead is written so
            // that nothing cancels: it closes in at the speed -f1, bent by f2.
            vec2 u = g - vec2(c), b = h.yz - h.x;
            float twist = h.x - h.y - h.z + h.w;
            float f0 = y - h.x - dot(b, u) - twist * u.x * u.y;
            float f1 = rd.y - dot(b, d) - twist * (u.x * d.y + u.y * d.x);
            float f2 = -twist * d.x * d.y, q = f1 * f1 - 4.0 * f0 * f2;
            float root = 2.0 * f0 / max(sqrt(max(q, 0.0)) - f1, 1e-12);
            if (q < 0.0 || sqrt(max(q, 0.0)) <= f1) root = kFar;
            if (f0 <= 0.0) root = 0.0;
            if (root <= leave - s) met = t0 + s + root;
            s = leave;
        }
        open = met == kFar && s < end;
    }
    return met;
}
// The reference: half a cell a step, then bisection.
float stepLand(vec3 ro, vec3 rd, float t0, float t1) {
    float dt = 0.5 / kPerCell, a = t0, b = t0;
    bool above = true;
    for (int k = 0; k < 2600 && above && a < t1; ++k) {
        b = min(t0 + float(k) * dt, t1);
        vec3 p = ro + b * rd;
        above = p.y > landHeight(p.xz);
        if (above) a = b;
        if (b >= t1) break;
    }
    if (above) return kFar;
    for (int k = 0; k < 24; ++k) {
        float m = 0.5 * (a + b);
        vec3 p = ro + m * rd;
        if (p.y > landHeight(p.xz)) a = m;
        else b = m;
    }
    return b;
}
float meetLand(vec3 ro, vec3 rd, float t0, float t1) {
    return march == 0 ? hitLand(ro, rd, t0, t1) : stepLand(ro, rd, t0, t1);
}
// Where a ray is in the block's box; entered: the face by which it comes in, outwards.
vec2 blockSpan(vec3 ro, vec3 rd, out vec3 entered) {
    vec3 inverse = safeInverse(rd), lo = vec3(-kHalf, kBase, -kHalf);
    vec3 a = (lo - ro) * inverse, b = (vec3(kHalf, landTop(), kHalf) - ro) * inverse;
    vec3 near = min(a, b), far = max(a, b);
    float t = max(near.x, max(near.y, near.z));
    entered = t == near.y ? vec3(0.0, 1.0, 0.0) : t == near.x ? vec3(1.0, 0.0, 0.0)
        : vec3(0.0, 0.0, 1.0);
    entered *= mix(vec3(1.0), vec3(-1.0), greaterThan(rd, vec3(0.0)));
    return vec2(max(t, 0.0), min(far.x, min(far.y, far.z)));
}
// What a ray from outside meets first: land, the block's sides and bottom, water or its sides.
Hit intersect(vec3 ro, vec3 rd) {
    vec3 face;
    vec2 span = blockSpan(ro, rd, face);
    Hit h = Hit(kFar, kSky, face);
    if (span.x > span.y * 1.000001) return h;
    vec3 p = ro + span.x * rd;
    float surface = (waterLevel - ro.y) / min(rd.y, -1e-9);   // of the water
    float level = rd.y < 0.0 && surface < span.y ? surface : kFar;
    if (span.x > 0.0 && face.y < 0.0) return Hit(span.x, kBottom, face);
    if (span.x > 0.0 && face.y == 0.0) {
        if (p.y <= landHeight(p.xz)) return Hit(span.x, kWall, face);
        if (p.y < waterLevel) return Hit(span.x, kSide, face);
    }
    h.t = meetLand(ro, rd, span.x, min(span.y, level));
    h.nor = vec3(0.0, 1.0, 0.0);
    if (h.t < kFar) h.id = kLand;
    else if (level < kFar) {
        h.t = max(level, span.x);
        h.id = kWater;
    }
    return h;
}

// ---- The sky ------------------------------------------------------------------------------------
// Sunlight scattered once in air that thins with height, summed along the ray into a small buffer;
// clouds are a flat layer of noise. A cone that is wider than a cloud sees their mean: what water
// mirrors is read from a smaller mip level, and so does not swirl.

// Density of air (Rayleigh, Mie, ozone) at a height, relative to the sea's level.
vec3 airDensity(float y) {
    return vec3(exp(-y / 8e3), exp(-y / 1.2e3), max(0.0, 1.0 - abs(y - 25e3) / 15e3));
}
// Height along a ray from height y0 with sine of elevation s; a parabola stands for the sphere.
float airHeight(float y0, float s, float t) {
    return y0 + t * (s + t * (1.0 - s * s) / (2.0 * kEarth));
}
float airLength(float y0, float s) {   // to the top of the air
    float a = (1.0 - s * s) / (2.0 * kEarth), c = y0 - kAir;
    return -2.0 * c / max(s + sqrt(max(s * s - 4.0 * a * c, 0.0)), 1e-6);
}
vec3 airExtinction(vec3 density) {
    return kRayleigh * density.x + vec3(1.1 * kMie * haze * density.y) + kOzone * density.z;
}
vec3 airTransmittance(float y0, float s, int steps) {
    float far = airLength(y0, s);
    vec3 sum = vec3(0.0);
    for (int k = 0; k < steps; ++k) {   // finer near the start, where air is dense
        float a = square(float(k) / float(steps)), b = square(float(k + 1) / float(steps));
        sum += airExtinction(airDensity(max(airHeight(y0, s, 0.5 * (a + b) * far), 0.0))) * (b - a);
    }
    return exp(-sum * far);
}
vec3 sunBeam() { return texelFetch(ambient, ivec2(6, 0), 0).rgb; }

// The clear sky, from its buffer: sine of half the angle from the sun's azimuth, root of height.
vec3 clearSky(vec3 rd) {
    vec2 level = normalize(rd.xz + vec2(0.0, 1e-9));
    vec2 sun = normalize(sunDirection().xz + vec2(0.0, 1e-9));
    vec2 uv = vec2(sqrt(max(0.5 - 0.5 * dot(level, sun), 0.0)), sqrt(clamp(rd.y, 0.0, 1.0)));
    return textureLod(sky, (0.5 + uv * vec2(255.0, 127.0)) / vec2(256.0, 128.0), 0.0).rgb;
}
vec3 ambientLight(vec3 nor) {   // from all around, on a surface that faces nor
    vec3 sum = vec3(0.0);
    for (int k = 0; k < 3; ++k) {
        int face = 2 * k + (nor[k] > 0.0 ? 1 : 0);
        sum += texelFetch(ambient, ivec2(face, 0), 0).rgb * square(nor[k]);
    }
    return sum;
}
vec3 daylight() {   // on level ground
    return texelFetch(ambient, ivec2(3, 0), 0).rgb + sunBeam() * sin(radians(sunHeight));
}

float lodOf(float w) { return clamp(log2(max(w, 1e-6) * 512.0), 0.0, 9.0); }   // w: in tiles
// What is seen along rd where the block is not: sky and clouds all round, below as above.
// width: angle that is averaged, rad; disc: with the sun.
vec3 background(vec3 rd, float width, bool disc) {
    vec3 sun = sunDirection(), sum = clearSky(vec3(rd.x, abs(rd.y), rd.z));
    float away2 = max(2.0 - 2.0 * dot(rd, sun), 0.0);
    if (rd.y < 0.0) sum *= 1.0 + 0.25 * rd.y;
    if (clouds > 0.0) {
        float y = abs(rd.y) + 0.30, w = 0.26 * width / (y * sqrt(y));   // both axes' mean
        vec2 p = rd.xz / y * 0.26 + (rd.y < 0.0 ? 0.37 : 0.0), wind = vec2(cycles(0.0012), 0.0);
        vec3 n = 0.66 * textureLod(cloudTile, p + wind, lodOf(w)).xyz
            + 0.34 * textureLod(cloudTile, 3.0 * p.yx - wind.yx, lodOf(3.0 * w)).xyz;
        vec2 sunward = normalize(sun.xz + vec2(0.0, 1e-9));
        float soft = 0.17 + min(3.0 * w, 0.3), level = 1.02 - 0.9 * clouds;
        float cover = smoothstep(level - soft, level + soft, n.x);
        float lit = clamp(0.5 + 1.2 * dot(n.yz, sunward), 0.0, 1.0) * (1.0 - 0.35 * cover);
        float silver = 0.03 + 0.15 * lit + 0.20 / (1.0 + 14.0 * away2);
        vec3 sunny = mix(sunBeam(), vec3(dot(sunBeam(), vec3(1.0 / 3.0))), 0.5);
        vec3 white = sunny * silver + texelFetch(ambient, ivec2(2, 0), 0).rgb * 0.12
            + texelFetch(ambient, ivec2(3, 0), 0).rgb * 0.12;
        cover *= smoothstep(0.0, 0.16, abs(rd.y)) * 0.9;
        sum = mix(sum, white, cover);
    }
    if (disc) {
        float r2 = square(radians(sunSize)), edge = max(width, 1e-4) * 0.5 * sqrt(r2);
        float seen = 1.0 - smoothstep(r2 - edge, r2 + edge, away2);
        sum += sunBeam() * (seen * 30.0 + 0.0003 / (away2 + 0.0008)) * step(-0.02, rd.y);
    }
    return sum;
}

// ---- Water --------------------------------------------------------------------------------------
// The lake is level; its waves are slopes in a buffer. A mip level of it holds the mean of slopes
// and of their squares, so the variance that a pixel hides is E[s^2] - E[s]^2 (Olano and Baker): it
// widens the lobe of the sun, P(slope that mirrors the sun to the eye), instead of being lost.

vec3 waterLoss() { return -log(clamp(linearColour(waterTint), 0.002, 0.998)) / 10.0; }   // 1/m

// Slopes of the lake and what a pixel of width w, seen along rd, cannot show of them: the mean of
// their squares less the square of their mean (Olano and Baker 2010).
Sea lakeAt(vec2 p, vec3 rd, float w) {
    float grown = w / max(-rd.y, 0.02);
    vec2 along = unit(vec3(rd.xz, 1e-6)).xy * grown / 3.0;
    float lod = log2(max(max(w, grown / 3.0) * kPerCell, 1.0));
    vec4 mean = vec4(0.0);
    for (int k = -1; k < 2; ++k)
        mean += textureLod(waves, (p + float(k) * along) / (2.0 * kHalf) + 0.5, lod) / 3.0;
    vec2 lost = max(mean.zw - mean.xy * mean.xy, 0.0) + kCalmSpread;
    return Sea(0.0, mean.xy, vec3(lost, 0.0), 0.0);
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
// What a pixel of width w shows of it. Waves larger than its parts bend within it, which no one
// Gaussian describes: each part is looked at with its own. Half as wide as the parts lie apart, for
// a Gaussian's tails are longer than those of waves.
float lakeGlitter(vec2 p, vec3 rd, float w) {
    float grown = w / max(-rd.y, 0.02), light = 0.0, shown = 0.0;
    vec2 ahead = unit(vec3(rd.xz, 1e-6)).xy, aside = vec2(-ahead.y, ahead.x);
    float part = 0.5 * sqrt(w * grown / float(glitterSamples));
    float lod = log2(max(part * kPerCell, 1.0));
    for (int k = 0; k < glitterSamples; ++k) {   // a lattice of the golden ratio
        float u = (float(k) + 0.5) / float(glitterSamples), v = fract(kGolden * float(k) + 0.25);
        vec2 at = p + (u - 0.5) * grown * ahead + (v - 0.5) * w * aside, slope;
        vec4 mean = textureLod(waves, at / (2.0 * kHalf) + 0.5, lod);
        vec2 lost = max(mean.zw - mean.xy * mean.xy, 0.0) + kCalmSpread;
        Sea s = Sea(0.0, mean.xy, vec3(lost, 0.0), 0.0);
        float area = shownSlope(rd, s, slope);
        light += area * seaGlitter(rd, s, area);
        shown += area;
    }
    return light / shown;
}

// (1 - exp(-x)) / x for x >= 0
float meanTransmittance(float x) {
    return x < 0.02 ? 1.0 - x * 0.5 * (1.0 - x / 3.0 * (1.0 - x * 0.25)) : (1.0 - exp(-x)) / x;
}
// Light that water scatters towards the start of a ray of length t, from a point at a depth.
// Daylight fades with depth; the integral along the ray is exact.
vec3 lakeGlow(float depth, float rise, float t) {
    vec3 loss = waterLoss(), fade = 0.7 * loss, x = (loss - fade * rise) * t;
    float scattered = murk * min(loss.r, min(loss.g, loss.b));
    vec3 mean = vec3(meanTransmittance(x.r), meanTransmittance(x.g), meanTransmittance(x.b));
    return scattered * daylight() / (2.0 * kPi) * exp(-fade * max(depth, 0.0)) * mean * t;
}

// ---- Light on land ------------------------------------------------------------------------------
// Matt ground in sun and sky, whose shadow and open share were drawn once; Phong's lobe, strongest
// on damp shores. In the water a pair of rays is followed: one in the air and one in the water,
// which at each face trade what they carry by Fresnel's share.

// Colour of land: sand, meadow, rock, snow, trees; up: y of its normal; n, fine: of the
// tile; w: m on the ground that a pixel shows.
vec3 landColour(vec3 p, float up, float tree, vec4 n, vec4 fine, float w) {
    float y = p.y + 5.0 * (n.x - 0.5);
    vec3 grass = linearColour(grassColour);
    vec3 c = mix(grass * vec3(0.62, 0.80, 0.55), grass * vec3(1.25, 1.12, 0.85), fine.y);
    c = mix(c, grass * vec3(1.5, 1.10, 0.6), smoothstep(0.35, 1.0, p.y / max(rockLine, 1.0)));
    vec3 rock = linearColour(rockColour), cliff = mix(rock * 0.55, rock * 1.2, n.y);
    float bleak = smoothstep(0.7, 1.2, y / max(snowLine, 1.0));
    cliff = mix(cliff, vec3(0.30, 0.29, 0.30) * (0.6 + 0.8 * n.y), bleak);
    float layers = sin(2.1 * p.y + 7.0 * n.x) + 0.6 * sin(5.3 * p.y - 9.0 * n.y);
    cliff *= 1.0 + 0.12 * layers * clamp(1.4 - 2.0 * w, 0.0, 1.0);
    float steep = 1.0 - smoothstep(0.56, 0.74, up + 0.16 * (fine.x - 0.5));
    c = mix(c, cliff, max(steep, smoothstep(-2.5, 2.5, y - rockLine)));
    float shore = p.y - waterLevel + 1.2 * (fine.x - 0.5);
    vec3 sand = vec3(0.62, 0.49, 0.30) * (0.75 + 0.5 * fine.y);
    c = mix(mix(sand, cliff, 0.7 * steep), c, smoothstep(0.8, 1.5, shore));
    float cold = smoothstep(-1.2, 1.2, y - snowLine);
    c = mix(c, vec3(0.86, 0.89, 0.93), cold * smoothstep(0.42, 0.60, up + 0.15 * (fine.x - 0.5)));
    vec3 fir = vec3(0.035, 0.085, 0.030), crown = vec3(0.16, 0.22, 0.045);
    vec3 leaves = mix(fir, crown, smoothstep(0.5, 0.6, tree));
    leaves *= 0.65 + 1.1 * fract(tree * 7.0 + 0.15) * smoothstep(0.1, 0.3, tree);
    leaves = mix(leaves, vec3(0.8, 0.84, 0.9), 0.75 * cold * smoothstep(0.2, 0.6, up));
    return mix(c, leaves, smoothstep(0.04, 0.16, tree));
}
// Land at a point, or over a point of a wall: slope, height and tree, noise, y of its normal.
struct Ground { vec4 g, fine; float up; vec3 colour; };
// wall: normal of the block's side or bottom, whose noise lies in its plane; 0 on land itself.
Ground groundAt(vec3 p, vec3 wall, float w) {
    bool cut = wall != vec3(0.0), under = wall.y < 0.0;
    Ground s;
    s.g = textureLod(land, landUv(p.xz), 0.0);
    vec2 side = vec2(p.x + p.z, p.y);   // goes on round every corner
    vec2 at = !cut ? p.zx / 9.0 : under ? p.xz / 103.0 + 0.2 : side / 17.0;
    s.fine = textureLod(tile, at, lodOf(!cut ? w / 9.0 : under ? w / 103.0 : w / 17.0));
    vec4 n = textureLod(tile, p.xz / 41.0, lodOf(w / 41.0));
    s.up = inversesqrt(1.0 + dot(s.g.xy, s.g.xy));
    vec3 top = cut ? vec3(p.x, s.g.z, p.z) : p;
    s.colour = landColour(top, s.up, s.g.w, cut ? s.fine : n, s.fine, w);
    return s;
}
// Light from a point of land against d. wet: it may be under water.
vec3 landLight(Ground s, vec3 p, vec3 d, bool wet) {
    vec4 g = s.g, fine = s.fine, lit = textureLod(lightMap, landUv(p.xz), 0.0);
    float up = s.up;
    vec3 c = s.colour;
    float stony = (1.0 - smoothstep(0.7, 0.9, up)) * step(g.w, 0.02);
    vec2 slope = g.xy + (0.10 + 0.55 * stony) * fine.zw;
    vec3 nor = normalize(vec3(-slope, 1.0).xzy), sun = sunDirection();
    float damp = 1.0 - smoothstep(0.0, 0.5, p.y - waterLevel);
    vec3 sunny = sunBeam() * lit.x, around = ambientLight(nor) * lit.z;
    c = mix(c, 0.7 * c * sqrt(max(c, 0.0)), damp);
    float mirrorLine = max(dot(reflect(d, nor), sun), 0.0);   // Phong
    float shine = wet ? 0.0 : (0.25 + 0.75 * damp) * exp2(34.0 * (mirrorLine - 1.0));
    around += 0.12 * c * daylight() * (1.0 - up + (1.0 - lit.z));   // from ground to ground
    if (wet) {
        float depth = max(waterLevel - p.y, 0.0);
        vec3 down = refractExactly(-sun, vec3(0.0, 1.0, 0.0), 1.0 / kIorWater);
        sunny *= (1.0 - fresnel(sun.y, kIorWater)) * exp(-waterLoss() * depth / -down.y);
        if (caustics > 0.0) sunny *= textureLod(gathered, p.xz / (2.0 * kHalf) + 0.5, 0.0).x;
        around *= exp(-0.8 * waterLoss() * depth);
        sun = -down;
    }
    return (c * (sunny * max(dot(nor, sun), 0.0) + around) + shine * sunny) / kPi;
}
// Light from the block's sides and bottom: earth in layers under a fringe of grass.
vec3 wallLight(Ground s, vec3 p, vec3 nor, float w) {
    float along = p.x + p.z;
    vec4 fine = s.fine;
    bool under = nor.y < 0.0;   // cut like an agate
    float wavy = 2.2 * sin((p.x + 0.7 * p.z) / 13.0 + 2.0 * sin((p.x - p.z) / 29.0)) + 0.7 * fine.x;
    float bent = p.y + (under ? 34.0 * fine.x - 10.0 : wavy), stretched = under ? 0.0 : along;
    vec4 layer = textureLod(tile, vec2(stretched / 700.0, bent / 34.0), lodOf(w / 34.0));
    vec4 seam = textureLod(tile, vec2(stretched / 400.0, bent / 11.0), lodOf(w / 11.0));
    vec3 c = mix(vec3(0.20, 0.105, 0.058), vec3(0.56, 0.37, 0.21), smoothstep(0.30, 0.70, layer.y));
    c = mix(c, vec3(0.27, 0.24, 0.23), 0.85 - 0.85 * smoothstep(-17.0, -11.0, bent));
    c *= (0.50 + 0.95 * smoothstep(0.30, 0.70, seam.x)) * (0.90 + 0.20 * fine.y);
    float deep = under ? 30.0 : max(s.g.z - p.y, 0.0);
    c = mix(vec3(0.055, 0.034, 0.022), c, smoothstep(0.5, 2.0, deep + 1.2 * (fine.x - 0.5)));
    c = mix(s.colour, c, smoothstep(0.1, 0.45 + w, deep + 0.5 * (fine.y - 0.5)));
    nor = normalize(nor + 0.06 * (under ? vec3(fine.z, 0.0, fine.w)
        : fine.z * vec3(nor.z, 0.0, -nor.x) + vec3(0.0, fine.w, 0.0)));
    return c / kPi * (sunBeam() * max(dot(nor, sunDirection()), 0.0) + ambientLight(nor));
}

// A ray in the air and one in the water that belong to one pixel, and what they carry.
struct Pair { vec3 airO, airD, air, wetO, wetD, wet; };
// Where both meet land before their ends: how far off, and the light from there; in the air only
// if exact. A loop takes one after the other, for a driver compiles a copy of a function for each
// place that calls it.
struct Ends { float air, wet; vec3 lit, bed; };
Ends endsOnLand(Pair r, float airEnd, float wetEnd, float angle, float far, bool exact) {
    Ends e = Ends(kFar, kFar, vec3(0.0), vec3(0.0));
    for (int way = exact ? 0 : 1; way < 2; ++way) {
        bool wet = way == 1;
        vec3 ro = wet ? r.wetO : r.airO, rd = wet ? r.wetD : r.airD;
        float met = meetLand(ro, rd, 0.0, wet ? wetEnd : airEnd);
        float gone = wet ? min(met, wetEnd) : met;
        vec3 p = ro + gone * rd;
        vec3 light = landLight(groundAt(p, vec3(0.0), angle * (far + gone)), p, rd, wet);
        if (wet) {
            e.wet = met;
            e.bed = light;
        } else {
            e.air = met;
            e.lit = light;
        }
    }
    return e;
}
// What both find. width: angle that the ray in the air averages; angle: of a pixel; far: m to here.
// Each turn ends the ray in the air, in the sky or, if exact, on land. The ray in the water ends on
// the bed; or at a face, and there it hands on: with Fresnel's share F, 1 - F of what it carries
// becomes the next turn's ray in the air, and F stays in the water, mirrored.
vec3 renderPair(Pair r, float width, float angle, float far, bool exact, bool disc) {
    vec3 sum = vec3(0.0), loss = waterLoss(), entered;
    bool open = true;
    for (int k = 0; k < bends && open; ++k) {
        float airEnd = exact ? blockSpan(r.airO, r.airD, entered).y : 0.0;
        if (maxComponent(r.air) <= 0.0) airEnd = 0.0;
        vec3 inverse = safeInverse(r.wetD);
        vec3 edge = mix(vec3(-kHalf), vec3(kHalf), greaterThan(inverse, vec3(0.0)));
        vec3 sides = (edge - r.wetO) * inverse;
        float level = r.wetD.y > 0.0 ? (waterLevel - r.wetO.y) * inverse.y : kFar;
        float end = maxComponent(r.wet) > 0.0 ? max(min(min(sides.x, sides.z), level), 0.0) : 0.0;
        Ends e = endsOnLand(r, airEnd, end, angle, far, exact);
        float run = min(e.wet, end);
        vec3 beyond = e.air < kFar ? e.lit : background(r.airD, width, disc);
        sum += r.air * beyond;
        sum += r.wet * lakeGlow(waterLevel - r.wetO.y, r.wetD.y, run);
        r.wet *= exp(-loss * run);
        vec3 p = r.wetO + run * r.wetD;
        far += run;
        if (e.wet < kFar) sum += r.wet * e.bed;
        vec3 face = level <= min(sides.x, sides.z) ? vec3(0.0, 1.0, 0.0)
            : sides.x < sides.z ? vec3(sign(r.wetD.x), 0.0, 0.0) : vec3(0.0, 0.0, sign(r.wetD.z));
        vec3 nor = -face;
        if (face.y > 0.0) {
            vec2 slope = textureLod(waves, p.xz / (2.0 * kHalf) + 0.5, 1.0).xy;
            nor = -normalize(vec3(-slope, 1.0).xzy);
            if (dot(nor, r.wetD) > -0.02) nor = -face;
        }
        float share = fresnel(clamp(-dot(nor, r.wetD), 0.0, 1.0), 1.0 / kIorWater);
        r.air = e.wet < kFar ? vec3(0.0) : (1.0 - share) * r.wet;
        r.airO = p;
        r.airD = refractExactly(r.wetD, nor, kIorWater);
        r.wet *= e.wet < kFar ? 0.0 : share;
        r.wetO = p - 1e-4 * face;
        r.wetD = reflect(r.wetD, nor);
        if (face.y > 0.0) r.wetD.y = min(r.wetD.y, -0.01);
        width = angle + 0.02;
        disc = true;
        open = maxComponent(r.air + r.wet) > 0.01;
    }
    return sum;
}

// ---- Screen-space rays and camera ---------------------------------------------------------------
// The picture knows the depth at each of its pixels, and 1 / depth is linear along the image of a
// ray: the ray's image is walked until its depth passes what the picture shows. Each pixel also
// says how deep its land is behind it, so that a ray may pass behind a peak.

Eye camera() {
    bool dragged = iMouse != vec4(0.0);   // the middle of the picture is the camera's own place
    vec2 orbit = dragged ? iMouse.xy / iResolution.xy - 0.5 : vec2(0.0);
    float a = radians(cameraAngle) - 2.0 * kPi * orbit.x;
    float rise = radians(clamp(cameraRise - 180.0 * orbit.y, -88.0, 88.0));
    vec3 at = target + cameraDistance * vec3(sin(a) * cos(rise), sin(rise), cos(a) * cos(rise));
    if (max(abs(at.x), abs(at.z)) < kHalf + 0.5) {   // never inside the block
        float ground = max(landHeight(at.xz), waterLevel) + 0.7;
        at.y = 2.0 * at.y > ground + kBase ? max(at.y, ground) : min(at.y, kBase - 0.7);
    }
    vec3 forward = normalize(target + vec3(1e-3, 0.0, 0.0) - at);
    vec3 right = normalize(cross(forward, vec3(0.0, 1.0, 0.0)));
    return Eye(at, right, cross(right, forward), forward, focalLength / 24.0);
}
vec3 viewRay(Eye e, vec2 pixel) {
    vec2 uv = (pixel - 0.5 * iResolution.xy) / iResolution.y;
    return normalize(uv.x * e.right + uv.y * e.up + e.lens * e.forward);
}
vec3 toView(Eye e, vec3 p) { return (p - e.pos) * mat3(e.right, e.up, e.forward); }
vec2 toPixel(Eye e, vec3 v) { return 0.5 * iResolution.xy + iResolution.y * e.lens * v.xy / v.z; }
// A ray's image: pixel and depth at a share s of it, in perspective.
struct Line { vec2 pa, pb; float ka, kb; };
vec3 onLine(Line l, float s) { return vec3(mix(l.pa, l.pb, s), 1.0 / mix(l.ka, l.kb, s)); }

// How far a ray stays in land that it has met, to a factor of 2.
float depthOfLand(vec3 p, vec3 rd) {
    float t = 0.25;
    bool inside = true;
    for (int k = 0; k < 8 && inside; ++k) {
        vec3 q = p + 2.0 * t * rd;
        inside = q.y < landHeight(q.xz) && max(abs(q.x), abs(q.z)) < kHalf;
        if (inside) t *= 2.0;
    }
    return t;
}

int walkFetches = 0;   // of the depth buffer, for measurements
// A ray's image, and shares of it: as far as it is in the picture, a pixel, a step, its first
// pixel.
struct Track {
    Line l;
    float inside, perPixel, perStep, start;
};
// Clips a ray to the near plane and the picture. False where nothing is left.
bool layTrack(Eye e, vec3 ro, vec3 rd, float reach, out Track k) {
    vec3 a = toView(e, ro), d = toView(e, e.pos + rd);
    if (a.z <= kNear || reach <= 0.0) return false;
    if (a.z + reach * d.z < kNear) reach = (kNear - a.z) / d.z;   // towards the camera
    vec3 b = a + reach * d;
    k.l = Line(toPixel(e, a), toPixel(e, b), 1.0 / a.z, 1.0 / b.z);
    vec2 dp = k.l.pb - k.l.pa, size = iResolution.xy;
    vec2 room = mix(k.l.pa / max(-dp, 1e-4), (size - 0.01 - k.l.pa) / max(dp, 1e-4),
                    greaterThan(dp, vec2(0.0)));
    k.inside = clamp(min(room.x, room.y), 0.0, 1.0);
    k.perPixel = 1.0 / max(max(abs(dp.x), abs(dp.y)), 1.0);
    k.perStep = 1.0 / ceil(clamp(k.inside / k.perPixel, 1.0, float(reflectionSteps)));
    k.start = min(0.7 * k.perPixel, k.inside);
    return true;
}

// Where a walk stands: its last two places as shares of the line, and how much of it is done.
struct Step { float before, at, walked; };
void stepOn(Track k, inout Step s) {
    s.before = s.at;
    s.walked = min(s.walked + k.perStep, 1.0);
    s.at = mix(k.start, k.inside, s.walked);
}
// Steps until land lies between the depths of a step's ends. close: it was just above land, or
// below it by less than the land may be deep; past: and was so no more, so that what stands between
// two steps may have been met.
bool walkOn(Track k, inout Step s, inout bool open, inout bool close, inout bool past) {
    bool hit = false, near = false;
    for (int n = 0; n < reflectionSteps && open; ++n) {
        float z = onLine(k.l, s.at).z, zBefore = onLine(k.l, s.before).z;
        vec4 texel = textureLod(normalDepth, onLine(k.l, s.at).xy / iResolution.xy, 0.0);
        float deep = length(texel.xyz);
        ++walkFetches;
        hit = deep > 0.02 && max(z, zBefore) > texel.w
            && min(z, zBefore) - texel.w < deep + abs(z - zBefore);
        float over = texel.w - max(z, zBefore), slack = abs(z - zBefore);
        bool was = near;
        near = !hit && deep > 0.02 && over < 0.6 * slack && over > -2.0 * deep - 2.0 * slack;
        close = close || near;
        past = past || was && !near && !hit;
        open = !hit && s.at < k.inside;
        if (open) stepOn(k, s);
    }
    return hit;
}
// Halves the last step down to the pixel. True where the ray really meets what is shown there;
// vague: over an edge, or two pixels on it is hardly deeper below what is shown.
bool holds(Track k, Step s, bool hit, out vec2 at, out bool vague) {
    float low = s.before, high = s.at;
    for (int j = 0; j < 6 && hit; ++j) {
        float m = 0.5 * (low + high);
        vec3 q = onLine(k.l, m);
        if (q.z > textureLod(normalDepth, q.xy / iResolution.xy, 0.0).w) high = m;
        else low = m;
        ++walkFetches;
    }
    vec3 q = onLine(k.l, high), on = onLine(k.l, min(high + 2.0 * k.perPixel, k.inside));
    vec4 texel = texelFetch(normalDepth, ivec2(q.xy), 0);
    float behind = q.z - texel.w, deep = length(texel.xyz);
    float rise = abs(texelFetch(normalDepth, ivec2(on.xy), 0).w - texel.w);
    at = q.xy;
    vague = behind > 0.02 + 0.5 * rise || on.z - texel.w < 1.6 * rise;
    return hit && behind > -0.01 && behind < deep && deep > 0.02;
}

// Walks the depth buffer along a ray that ends after `reach`, where it is out of the block and in
// the sky. found: the pixel where it meets land; the value: how sure; 0 is a miss. A ray that
// leaves the picture before finds what stands at the border there, or fades towards it.
// doubtful: the picture does not tell for certain; exact rays do, at the price of some picture.
float walkPicture(Eye e, vec3 ro, vec3 rd, float reach, bool wanted, out vec2 found,
                  out bool doubtful) {
    found = vec2(0.0);
    doubtful = false;
    walkFetches = 0;
    Track k;
    if (!wanted || !layTrack(e, ro, rd, reach, k)) return 0.0;
    float sure = 0.0;
    Step s = Step(k.start, mix(k.start, k.inside, k.perStep), k.perStep);
    bool open = k.start < k.inside, close = false, past = false;
    for (int attempt = 0; attempt < 3 && open; ++attempt) {   // again where a hit does not hold
        vec2 at;
        bool vague, hit = walkOn(k, s, open, close, past);
        if (holds(k, s, hit, at, vague)) {
            found = at;
            sure = 1.0;
        }
        doubtful = doubtful || hit && (sure == 0.0 || vague || past);
        open = hit && sure == 0.0 && s.at < k.inside;
        stepOn(k, s);
    }
    doubtful = doubtful || sure == 0.0 && close;
    if (border == 0) {
        vec2 last = onLine(k.l, k.inside).xy;
        bool there = int(texelFetch(colours, ivec2(last), 0).w) == kLand;
        if (sure == 0.0 && k.inside < 1.0 && there) {
            found = last;
            sure = 1.0;
        }
    } else {
        vec2 rim = min(found, iResolution.xy - found) / iResolution.xy;
        sure *= smoothstep(0.0, 0.08, min(rim.x, rim.y));
    }
    return sure;
}

// ---- Passes -------------------------------------------------------------------------------------
// From what never changes to what always does: noise, land, its pyramid, sky and light are drawn
// once per look; waves and the picture's geometry every frame.

// Tiles of noise. Of the ground x and y are about 0 to 1, zw is a noise's slope, about -1 to 1: six
// octaves of x, from 4 cells on, six of y, from 8, three of zw, from 16. Of clouds x is thickness,
// about 0 to 1, and yz the slope of their bumps, down: six octaves from 4 cells on.
void mainTile(out vec4 ground, out vec4 cloud, in vec2 pixel) {
    vec2 p = pixel / iResolution.xy;
    ground = vec4(0.5, 0.5, 0.0, 0.0);
    cloud = vec4(0.5, 0.0, 0.0, 0.0);
    for (int k = 0; k < 21; ++k) {
        int what = k < 15 ? k / 6 : 3, octave = k < 15 ? k - 6 * what : k - 15;
        int cells = 4 << (k < 15 ? what + octave : octave);
        vec3 n = perlinPlane(p * float(cells), 2 + 10 * what + octave, cells - 1);
        float o = float(octave), gain = 0.72 * exp2(-o);
        if (what == 0) ground.x += gain * n.z;
        else if (what == 1) ground.y += gain * n.z;
        else if (what == 2) ground.zw += 0.5 * n.xy;
        else cloud.xyz += vec3(-0.30 * exp2(-0.45 * o) * n.xy, 0.78 * exp2(-0.95 * o) * n.z).zxy;
    }
}
void mainBare(out vec4 colour, in vec2 pixel) {
    vec3 h = bareLand((pixel - 0.5) / kPerCell - kHalf);
    colour = vec4(h, 0.0);
}
// With trees, one in a cell of a jittered grid: slope, height, and in w a tree's own number.
// Below 0.5 firs, above round crowns.
void mainLand(out vec4 colour, in vec2 pixel) {
    vec2 p = (pixel - 0.5) / kPerCell - kHalf;
    colour = texelFetch(bare, ivec2(pixel), 0);
    ivec2 cell = ivec2(floor(p / kTreeGap));
    for (int k = 0; k < 9; ++k) {
        ivec2 c = cell + ivec2(k % 3, k / 3) - 1;
        vec3 chance = random3(ivec3(c, 40 + landscape));
        vec3 look = random3(ivec3(c, 2000 + landscape));
        vec2 at = (vec2(c) + 0.5 + 0.62 * (chance.xy - 0.5)) * kTreeGap;
        vec3 ground = textureLod(bare, landUv(at), 0.0).xyz;
        float wood = perlinPlane(at / 13.0, 64 * landscape + 20, -1).z + 0.6 * (chance.z - 0.5);
        float above = ground.z - waterLevel, radius = mix(0.55, 1.0, look.x);
        bool grows = wood > 0.55 - trees && above > 1.1 && ground.z < rockLine + 2.0 * look.y
            && dot(ground.xy, ground.xy) < 0.7 && trees > 0.0
            && max(abs(at.x), abs(at.y)) < kHalf - radius - 0.2;
        bool fir = look.z + 0.5 * (ground.z / max(rockLine, 1.0)) > 0.62;
        vec2 d = p - at;
        float r = length(d) / radius;
        if (!grows || r >= 1.0) continue;
        float tall = fir ? 3.1 * radius : 1.7 * radius;
        float top = ground.z + tall * (fir ? 1.0 - r : 1.0 - r * r * r);
        vec2 slope = d / (max(r, 1e-3) * radius * radius) * -tall * (fir ? 1.0 : 3.0 * r * r);
        if (top > colour.z)
            colour = vec4(slope, top, fir ? mix(0.2, 0.45, look.y) : mix(0.65, 1.0, look.y));
    }
}
// From x = 0: the four corners of each patch. From x = 512: greatest heights of 4 x 4 of these,
// of 16 x 16 and of 64 x 64.
void mainPeaks(out vec4 colour, in vec2 pixel) {
    ivec2 c = ivec2(pixel);
    colour = vec4(0.0);
    if (c.x < kCells) {
        for (int k = 0; k < 4; ++k) colour[k] = texelFetch(land, c + ivec2(k & 1, k >> 1), 0).z;
        return;
    }
    c.x -= kCells;
    int level = c.y < 128 ? 1 : c.y < 160 ? 2 : 3, span = 1 << (2 * level);
    c.y -= level == 2 ? 128 : level == 3 ? 160 : 0;
    if (max(c.x, c.y) * span >= kCells) return;
    float top = -1e4;
    for (int j = 0; j <= span; ++j)
        for (int i = 0; i <= span; ++i)
            top = max(top, texelFetch(land, c * span + ivec2(i, j), 0).z);
    colour = vec4(top + 1e-4);
}

// Single scattering, with a share of light that has been scattered more often and comes from all
// around. x: sine of half the angle from the sun's azimuth, y: root of the sine of elevation.
void mainSky(out vec4 colour, in vec2 pixel) {
    vec2 uv = (pixel - 0.5) / vec2(255.0, 127.0);
    vec3 sun = sunDirection();
    float y = uv.y * uv.y, side = 1.0 - 2.0 * uv.x * uv.x, level = sqrt(max(1.0 - y * y, 0.0));
    float cosine = level * length(sun.xz) * side + y * sun.y;
    float far = airLength(1.0, y), g = 0.78;
    float rayleigh = 0.0596831 * (1.0 + cosine * cosine);
    float mie = 0.1193662 * (1.0 - g * g) * (1.0 + cosine * cosine)
        / ((2.0 + g * g) * pow(max(1.0 + g * g - 2.0 * g * cosine, 1e-3), 1.5));
    vec3 through = vec3(1.0), sum = vec3(0.0);
    for (int k = 0; k < 24; ++k) {
        float a = square(float(k) / 24.0), b = square(float(k + 1) / 24.0);
        float h = max(airHeight(1.0, y, 0.5 * (a + b) * far), 0.0), dt = (b - a) * far;
        vec3 density = airDensity(h), extinction = airExtinction(density);
        vec3 lost = exp(-extinction * dt);
        vec3 sunThere = airTransmittance(h, sun.y, 12), mean = pow(sunThere, vec3(0.4));
        vec3 scattered = kRayleigh * density.x * (rayleigh * sunThere + 0.028 * mean)
            + kMie * haze * density.y * (mie * sunThere + 0.028 * mean);
        sum += through * scattered * (1.0 - lost) / max(extinction, 1e-12);
        through *= lost;
    }
    colour = vec4(kSunPower * sum, 1.0);
}

// 0 to 5: light on a surface that faces -x +x -y +y -z +z, without the sun; 6: the sun's colour.
// From below comes what clouds there send back. 7: the greatest height of land.
void mainAmbient(out vec4 colour, in vec2 pixel) {
    int face = int(pixel.x);
    colour = vec4(kSunPower * airTransmittance(1.0, sin(radians(sunHeight)), 32), 1.0);
    if (face == 7) colour = vec4(kBed);
    for (int k = 0; k < 64 && face == 7; ++k)
        colour = max(colour, texelFetch(peaks, ivec2(kCells + (k & 7), 160 + (k >> 3)), 0));
    if (face > 5) return;
    vec3 axis = vec3(face / 2 == 0, face / 2 == 1, face / 2 == 2) * (float(face & 1) * 2.0 - 1.0);
    vec3 sum = vec3(0.0), under = colour.rgb * sin(radians(sunHeight)) * (0.3 / kPi);
    for (int k = 0; k < 512; ++k) {
        float y = (float(k) + 0.5) / 256.0 - 1.0, a = 2.0 * kPi * kGolden * float(k);
        vec3 rd = vec3(sqrt(1.0 - y * y) * vec2(cos(a), sin(a)), y).xzy;
        vec3 light = clearSky(vec3(rd.x, abs(y), rd.z));
        if (y < 0.0) light = 0.35 * light + under;
        sum += light * max(dot(rd, axis), 0.0) * (4.0 * kPi / 512.0);
    }
    colour = vec4(sum, 1.0);
}
// A ray to the sun's disc; a: where its column stands, from pi to 0; row: from the lowest.
vec3 sunRay(float a, int row) {
    vec3 sun = sunDirection();
    float level = length(sun.xz), radius = radians(sunSize);
    float side = clamp(sin(radius * cos(a)) / level, -1.0, 1.0), ahead = sqrt(1.0 - side * side);
    vec2 along = sun.xz / level, way = ahead * along + side * vec2(-along.y, along.x);
    vec2 mid = normalize(vec2(ahead * level, sun.y));
    float rise = radius * sin(a) * (2.0 * (float(row) + 0.5) / float(kSunRows) - 1.0);
    vec2 rd = mid * cos(rise) + vec2(-mid.y, mid.x) * sin(rise);
    return vec3(way.x * rd.x, max(rd.y, 1e-3), way.y * rd.x);
}
// Share of the sun's disc seen from land (x; below water, from where the light enters it) and from
// the water (y); how open the sky is (z). The disc is summed over columns (Gauss and Chebyshev, of
// the second kind). Above a ray to the sky that passes over land all in its upright plane do: of a
// column the lowest ray is traced, then the highest, then the one between, and most need no more.
void mainLightMap(out vec4 colour, in vec2 pixel) {
    vec2 p = (pixel - 0.5) / kPerCell - kHalf;
    vec4 g = texelFetch(land, ivec2(pixel), 0);
    vec3 nor = normalize(vec3(-g.x, 1.0, -g.y)), face;
    vec3 down = refractExactly(-sunDirection(), vec3(0.0, 1.0, 0.0), 1.0 / kIorWater);
    bool wet = g.z < waterLevel;
    vec3 low = vec3(p.x, g.z, p.y) + 0.04 * nor, high = vec3(p.x, waterLevel, p.y);
    if (wet) low = vec3(p + down.xz * ((waterLevel - g.z) / down.y), waterLevel).xzy;
    low.xz = clamp(low.xz, -kHalf, kHalf);
    vec2 seen = vec2(0.0);
    int columns = wet ? 2 * shadowSamples : shadowSamples, column = 0;
    int blocked = 0, clear = kSunRows;   // the first that may be clear, and the first that is
    for (int k = 0; k < 5 * columns && column < columns; ++k) {
        bool below = column < shadowSamples;
        float a = kPi * float((below ? column : column - shadowSamples) + 1)
            / float(shadowSamples + 1);
        int row = blocked == 0 ? 0 : clear == kSunRows ? kSunRows - 1 : (blocked + clear) / 2;
        vec3 ro = below ? low : high, rd = sunRay(a, row);
        if (hitLand(ro, rd, 0.0, blockSpan(ro, rd, face).y) < kFar) blocked = row + 1;
        else clear = row;
        if (blocked < clear) continue;
        float share = 2.0 * square(sin(a)) / float(shadowSamples + 1)
            * (1.0 - float(blocked) / float(kSunRows));
        seen += below ? vec2(share, 0.0) : vec2(0.0, share);
        ++column;
        blocked = 0;
        clear = kSunRows;
    }
    float open = 0.0;
    for (int k = 0; k < 10; ++k) {
        vec2 way = vec2(cos(0.2 * kPi * float(k)), sin(0.2 * kPi * float(k)));
        float rise = 0.0, far = 0.35;
        for (int j = 0; j < 6; ++j) {
            rise = max(rise, (landHeight(p + far * way) - g.z) / far);
            far *= 2.2;
        }
        open += 0.1 / (1.0 + rise * rise);   // squared cosine of the horizon's height
    }
    colour = vec4(seen, open, 0.0);
}

// Slope of the waves. Shallows are calm.
vec2 waveSlope(vec2 p) {
    vec2 slope = vec2(0.0);
    float depth = waterLevel - textureLod(land, landUv(p), 0.0).z;
    float steep = waveHeight * (0.6 + 0.4 * smoothstep(0.0, 3.0, depth)) / waveLength;
    float lattice = waveLength, hz = 0.9 * inversesqrt(waveLength);   // long waves are slower
    for (int k = 0; k < 4 && depth > -0.5; ++k) {
        float angle = 0.4 + 0.75 * float(k);
        vec2 q = turn(p, angle) / lattice, c = floor(q);
        float when = float(kWaveCells) * cycles(hz / float(kWaveCells)), w = floor(when);
        vec4 n = perlinIn(ivec3(ivec2(c), int(w) & (kWaveCells - 1)), vec3(q - c, when - w),
                          ivec3(-1, -1, kWaveCells - 1));
        slope += steep * turn(n.xy, -angle);
        lattice *= 0.5;
        hz *= 1.41421356;
    }
    return slope;
}
void mainWaves(out vec4 colour, in vec2 pixel) {   // slopes and their squares
    vec2 slope = waveSlope((pixel / iResolution.xy - 0.5) * 2.0 * kHalf);
    colour = vec4(slope, slope * slope);
}
// Sunlight that waves gather on the bed: 1/|J| of the map from where light enters the water.
void mainGathered(out vec4 colour, in vec2 pixel) {
    vec2 p = (pixel / iResolution.xy - 0.5) * 2.0 * kHalf;
    float depth = max(waterLevel - textureLod(land, landUv(p), 0.0).z, 0.0);
    vec3 down = refractExactly(-sunDirection(), vec3(0.0, 1.0, 0.0), 1.0 / kIorWater);
    float lod = clamp(0.6 + 0.16 * depth, 1.0, 5.0), e = 0.3 * exp2(lod - 1.0);   // m
    vec2 uv = (p + down.xz * (depth / down.y)) / (2.0 * kHalf) + 0.5;
    vec2 aside = vec2(e / (2.0 * kHalf), 0.0), here = textureLod(waves, uv, lod).xy;
    vec2 x = (textureLod(waves, uv + aside.xy, lod).xy - here) / e;
    vec2 z = (textureLod(waves, uv + aside.yx, lod).xy - here) / e;
    float bend = 0.25 * min(depth, 6.0);
    float j = (1.0 + bend * x.x) * (1.0 + bend * z.y) - bend * bend * x.y * z.x;
    colour = vec4(mix(1.0, 1.0 / clamp(abs(j), 0.4, 4.0), caustics));
}

// colours: light from land and the block's sides; for water its lost slope variance; in w the kind
// of surface. normalDepth: the normal, as long as land is deep behind the pixel, and the depth
// along the view's axis.
void mainGBuffer(out vec4 colour, out vec4 normal, in vec2 pixel) {
    Eye e = camera();
    vec3 rd = viewRay(e, pixel);
    float angle = 1.0 / (e.lens * iResolution.y);
    Hit h = intersect(e.pos, rd);
    vec3 p = e.pos + min(h.t, 1e5) * rd;
    float w = angle * h.t, axis = dot(rd, e.forward);
    colour = vec4(0.0, 0.0, 0.0, float(h.id) + 0.5);
    normal = vec4(0.0, 1.0, 0.0, kFar);
    if (h.id == kSky) return;
    normal = vec4(0.01 * h.nor, h.t * axis);
    Ground ground = groundAt(p, h.id == kWall || h.id == kBottom ? h.nor : vec3(0.0), w);
    if (h.id == kLand) {
        colour.rgb = landLight(ground, p, rd, false);
        normal.xyz = normalize(vec3(-ground.g.xy, 1.0).xzy) * (depthOfLand(p, rd) * axis);
    } else if (h.id == kWater) {
        Sea s = lakeAt(p.xz, rd, w);
        colour.rgb = s.spread;
        normal.xyz = 0.01 * normalize(vec3(-s.slope, 1.0).xzy);
    } else if (h.id != kSide) {
        colour.rgb = wallLight(ground, p, h.nor, w);
    }
}

// Light to the eye, and in w 1 / depth.
void pictureAt(out vec4 colour, in vec2 pixel) {
    Eye e = camera();
    vec3 rd = viewRay(e, pixel);
    float angle = 1.0 / (e.lens * iResolution.y), width = angle;
    vec4 stuff = texelFetch(colours, ivec2(pixel), 0);
    vec4 facing = texelFetch(normalDepth, ivec2(pixel), 0);
    int id = int(stuff.w);
    bool onWater = id == kWater;
    float t = min(facing.w, 1e5) / dot(rd, e.forward);
    vec3 p = e.pos + t * rd, nor = normalize(facing.xyz), away = reflect(rd, nor);
    if (onWater) p.y = waterLevel;
    Sea s = Sea(0.0, -nor.xz / max(nor.y, 1e-3), stuff.rgb, 0.0);
    vec2 slope;
    shownSlope(rd, s, slope);
    if (onWater) {   // biased: light between waves is left out, so none goes down
        nor = normalize(vec3(-slope, 1.0).xzy);
        away = reflect(rd, nor);
        away = normalize(vec3(away.x, max(away.y, 0.02), away.z));
        width += 2.0 * sqrt(max(s.spread.x, s.spread.y));
    }
    float share = fresnel(clamp(-dot(nor, rd), 0.0, 1.0), kIorWater), sure = 0.0;
    vec3 down = refractExactly(rd, nor, 1.0 / kIorWater), entered;
    vec2 found = vec2(0.0);
    bool exact = reflections == 2 && id >= kWater, doubtful;
    if (reflections == 1) {
        sure = walkPicture(e, p, away, blockSpan(p, away, entered).y, onWater, found, doubtful);
        if (doubtful) sure = 0.0;
        exact = doubtful;
    }
    Pair pair = Pair(p, away, vec3(share * (1.0 - sure)), p - 1e-4 * nor, down, vec3(1.0 - share));
    if (id < kWater) {
        pair.airD = rd;
        pair.air = vec3(id == kSky ? 1.0 : 0.0);
        pair.wet = vec3(0.0);
    }
    vec3 sum = renderPair(pair, width, angle, t, exact, !onWater);
    if (onWater) {
        sum += share * sure * texelFetch(colours, ivec2(found), 0).rgb;
        float sunny = textureLod(lightMap, landUv(p.xz), 0.0).y;
        sum += sunBeam() * (sunny * lakeGlitter(p.xz, rd, angle * t));
    }
    if (id != kSky && id < kWater) sum = stuff.rgb;
    colour = vec4(sum, id == kSky ? 0.0 : 1.0 / facing.w);
}
// Drawn and kept where a lens blurs it; else the image is it, without a buffer. Loops, for nothing
// else is skipped where tweaks are uniforms.
void mainPicture(out vec4 colour, in vec2 pixel) {
    colour = vec4(0.0);
    for (int k = tiltShift > 0.0 ? 0 : 1; k < 1; ++k) pictureAt(colour, pixel);
}

// ---- Image --------------------------------------------------------------------------------------
// Land is lit already where the pass of geometry met it. Water is left: what it mirrors, by the
// picture or exactly, and what is seen in it.

// Light to display: clamped first, then the largest channel rolls off, the others keep their ratio
// to it, with a little white at the top as on film; then sRGB. NaN and negatives 0, infinity 1.
vec3 display(vec3 light) {
    vec3 x = mix(vec3(0.0), min(light, 65504.0), greaterThan(light, vec3(0.0)));
    float peak = max(maxComponent(x), 1e-6), rolled = 1.0 - exp(-peak);
    vec3 c = mix(x * (rolled / peak), vec3(rolled), 0.35 * pow(rolled, 12.0));
    c = clamp(c, 0.0, 1.0);
    return mix(12.92 * c, 1.055 * pow(max(c, 1e-6), vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c));
}

// Pixels from the middle to the rim of the blur of a point at depth 1 / inverseDepth.
float blurRadius(float inverseDepth) {
    float r = tiltShift * iResolution.y * abs(1.0 - cameraDistance * inverseDepth);
    return min(r, 0.04 * iResolution.y);
}
// What a lens shows that is in focus at the point looked at: taps count as far as their own blur
// reaches; what is farther off than the middle does not spread over it.
vec3 throughLens(vec2 pixel) {
    vec4 here = texelFetch(picture, ivec2(pixel), 0);
    float radius = blurRadius(here.w);
    vec4 sum = vec4(here.rgb, 1.0);
    if (radius < 0.25) return sum.rgb;
    float lod = max(log2(1.6 * radius * inversesqrt(float(lensSamples))), 0.0);
    for (int k = 0; k < lensSamples; ++k) {
        float r = radius * sqrt((float(k) + 0.5) / float(lensSamples));
        float a = 2.0 * kPi * kGolden * float(k);
        vec2 at = pixel + r * vec2(cos(a), sin(a));
        vec4 tap = textureLod(softPicture, at / iResolution.xy, lod);
        float own = blurRadius(tap.w);
        if (tap.w < here.w) own = min(own, radius);
        sum += vec4(tap.rgb, 1.0) * clamp(own - r + 1.0, 0.0, 1.0);
    }
    return mix(here.rgb, sum.rgb / sum.w, smoothstep(0.25, 1.0, radius));
}

// What hides the bands of a smooth picture of 255 steps: half a step, up or down by chance. It is
// the same for all samples of a pixel: their mean is rounded, and of many none would be left.
vec3 dither(vec2 fragCoord) {
    vec3 chance = random3(ivec3(16 * ivec2(fragCoord) + 8, 3));
    return (chance + chance.yzx - 1.0) * (0.5 / 255.0);
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec4 sharp = vec4(0.0);
    for (int k = tiltShift > 0.0 ? 1 : 0; k < 1; ++k) pictureAt(sharp, fragCoord);
    vec3 light = tiltShift > 0.0 ? throughLens(fragCoord) : sharp.rgb;
    fragColor = vec4(display(exp2(exposure) * light) + dither(fragCoord), 1.0);
}
