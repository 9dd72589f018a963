// Everything that a page draws: every kind of pass, filler, tweak and input, each in a cell of the picture that tells
// whether it arrived. tests/web/page compares it with a still and plays on it.

#include "shared.glsl"

//@ group Colours
uniform vec3 tint;             //@ #336699 "of the first cell"
uniform float level;           //@ 0.5 [0, 1] unit=cd "of the second"
//@ group Shapes
uniform int count;             //@ 3 [1, 64] log "stripes of the third"
uniform int kind;              //@ 1 {none, plain, bright} "of the fourth"
uniform bool isOn;             //@ on "whether the fifth is lit"
uniform vec2 shift;            //@ 0.25,0.75 [0, 1] "of the sixth"
uniform float none;            //@ 0 [0, 1] "by which the sixth is divided"

uniform sampler2D keys;        //@ keyboard
uniform sampler2D grain;       //@ noise rgba 16 filter=nearest wrap=repeat
uniform sampler3D cloud;       //@ noise r 8 filter=mipmap
uniform sampler2D trail;       //@ pass mainTrail
uniform sampler2D left;        //@ pass mainTwo size=16x9 format=rgba16f filter=mipmap
uniform sampler2D right;       //@ pass mainTwo size=16x9 format=rgba16f
uniform samplerCube sky;       //@ pass mainSky size=16 format=rgba8
uniform sampler2D walk;        //@ pass mainWalk size=4x1 step=1/240 filter=nearest

// What was there, a little paler, and a mark that moves.
void mainTrail(out vec4 color, in vec2 coord) {
    color = texelFetch(trail, ivec2(coord), 0) * 0.9;
    if (distance(coord, iResolution.xy * fract(iTime * vec2(1.0, 0.5))) < 6.0) color = vec4(1.0);
}

void mainTwo(out vec4 a, out vec4 b, in vec2 coord) {
    a = vec4(coord / iResolution.xy, 0.5, 1.0);
    b = texture(trail, coord / iResolution.xy);
}

void mainSky(out vec4 color, in vec2 coord, in vec3 rayOri, in vec3 rayDir) {
    color = vec4(rayDir * 0.5 + 0.5, 1.0);
}

// Counts its steps, and those in which space was held.
void mainWalk(out vec4 color, in vec2 coord) {
    color = texelFetch(walk, ivec2(coord), 0) + vec4(1.0, texelFetch(keys, ivec2(32, 0), 0).r, iTimeDelta, 0.0);
}

vec3 cell(int index, vec2 p) {
    if (index == 0) return tint;
    if (index == 1) return vec3(level);
    if (index == 2) return vec3(fract(p.x * float(count)));
    if (index == 3) return vec3(float(kind) * 0.5);
    if (index == 4) return vec3(isOn);
    if (index == 5) return vec3(shift, (p.x + 0.1) / none > 1e30);
    if (index == 6) return texture(grain, p).rgb;
    if (index == 7) return vec3(textureLod(cloud, vec3(p, 0.3), 1.0).r);
    if (index == 8) return texture(trail, p).rgb;
    if (index == 9) return textureLod(left, p, 1.5).rgb + 0.2 * texture(right, p).rgb;
    if (index == 10) return texture(sky, vec3(p - 0.5, 0.4)).rgb;
    if (index == 11) return texelFetch(walk, ivec2(p * 4.0), 0).xyz / vec3(1000.0, 200.0, 4.0);
    if (index == 12) return shared(iMouse.xy / iResolution.xy);
    if (index == 13) return vec3(iMouse.z > 0.0, iMouse.w > 0.0, iMouse.z < 0.0);
    if (index == 14) return vec3(texelFetch(keys, ivec2(32, 0), 0).r, texelFetch(keys, ivec2(32, 2), 0).r, 0.0);
    return vec3(fract(iTime), float(iFrame % 64) / 64.0, float(iTick >> 8 & 255u) / 255.0);
}

void mainImage(out vec4 color, in vec2 coord) {
    vec2 p = coord / iResolution.xy * 4.0;
    color = vec4(cell(int(p.x) + 4 * int(p.y), fract(p)), 1.0);
}
