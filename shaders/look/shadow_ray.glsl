// Which ray a pixel's shadow is found along. The same for all pixels that lie four apart: no vectors.

const float kLightRadius = 0.09F; // seen from a point, as a tangent (tuned by eye: shadows of contacts stay clear)

// Towards a point of the light, of any length, y up and z towards the eye; w: where in a step the first one begins.
// `turned`: other points and other steps, from 0 to 1.
vec4 shadow_ray(int column, int row, float turned) {
    float number = first_turn(column, row) * (1.0F / 0.39269908F); // 0 to 15
    float angle = 2.39996323F * number + 6.2831853F * turned; // sixteen points evenly over a disc
    float radius = kLightRadius * sqrt((number + 0.5F) * (1.0F / 16.0F));
    float across = radius * cos(angle), up = radius * sin(angle);
    float step = 0.4375F * number + 0.0625F * turned + 0.03125F; // sevenths: far apart where points are close
    return vec4(-0.429F + 0.8F * across - 0.4194F * up, 0.572F + 0.6F * across + 0.5592F * up, 0.699F - 0.715F * up,
                step - floor(step));
}
