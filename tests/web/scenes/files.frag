// Files of every kind, side by side, which tests/web/page makes; and with noise, steps, channels and a sound all that a
// page may carry.
uniform sampler2D song;    //@ sound song.wav
uniform samplerCube room;  //@ cube room.exr
uniform sampler3D cloud;   //@ volume cloud.bin
uniform sampler2D letters; //@ image letters.png filter=mipmap
uniform sampler2D grain;   //@ noise r 4 filter=nearest
uniform sampler2D count;   //@ pass mainCount size=1x1 step=1/60

void mainCount(out vec4 color, in vec2 coord) { color = texelFetch(count, ivec2(0), 0) + 1.0 / 64.0; }

vec2 mainSound(int samp, float time) { return vec2(fract(time)); }

void mainImage(out vec4 color, in vec2 coord) {
    vec2 p = coord / iResolution.xy;
    if (p.x < 0.25)
        color = vec4(texture(song, vec2(p.y, 0.25)).r, texture(song, vec2(p.y, 0.75)).r, texelFetch(count, ivec2(0), 0).r, 1.0);
    else if (p.x < 0.5)
        color = texture(room, vec3(p * 2.0 - 1.0, 0.5));
    else
        color = p.x < 0.75 ? vec4(texture(cloud, vec3(p * 4.0, iTime)).r, texture(grain, p).r, iChannelTime[0], 1.0) : textureLod(letters, p * 3.0, 1.0);
}
