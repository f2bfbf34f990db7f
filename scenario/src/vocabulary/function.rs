//! The functions of the language.

use super::words;

words! {
    /// A function; its documentation begins with its signature.
    Function {
        Abs = "abs", "abs(x): the absolute value, in the unit of x";
        Min = "min", "min(a, b, …) or min(E for p in S where C): the least";
        Max = "max", "max(a, b, …) or max(E for p in S where C): the greatest";
        Clamp = "clamp", "clamp(x, low, high): x limited to low..high";
        Exp = "exp", "exp(x): e to the power x";
        Log = "log", "log(x): the natural logarithm";
        Pow = "pow", "pow(x, y): x to the power y";
        Sqrt = "sqrt", "sqrt(x): the square root";
        Floor = "floor", "floor(x): rounded down";
        Ceil = "ceil", "ceil(x): rounded up";
        Round = "round", "round(x): to the nearest whole number";
        Mod = "mod", "mod(a, b): the remainder of a / b, with the sign of b";
        Sin = "sin", "sin(angle)";
        Cos = "cos", "cos(angle)";
        Smoothstep = "smoothstep", "smoothstep(low, high, x): 0 below low, 1 above high, smooth between";
        Distance = "distance", "distance(a, b): metres along the ground";
        GrfDistance = "grf_distance", "grf_distance(a, b): in GRF's normalised units, a plain number";
        Angle = "angle", "angle(a, b): the heading from a to b";
        Speed = "speed", "speed(x): of a player or the ball";
        Polar = "polar", "polar(r, angle): a vector, or a velocity";
        Nearest = "nearest", "nearest(S, to: p): the player of S nearest to p";
        Count = "count", "count(p in S where C): how many";
        Any = "any", "any(p in S where C): whether one is";
        All = "all", "all(p in S where C): whether every one is";
        Sum = "sum", "sum(E for p in S where C): the total";
        Mean = "mean", "mean(E for p in S where C): the average";
        MinBy = "min_by", "min_by(E for p in S where C): the player with the least E";
        MaxBy = "max_by", "max_by(E for p in S where C): the player with the greatest E";
        Exists = "exists", "exists(p): whether p is a player (not nobody)";
        Pressed = "pressed", "pressed(p, within: d): an opponent of p is nearer than d";
        Sees = "sees", "sees(p, a, within: angle): a lies within this angle of where p faces, half to each side";
        OffsideLine = "offside_line", "offside_line(team): normalised x of its offside line";
        Closing = "closing", "closing(a, b): the metres by which they came closer in this step";
        Prev = "prev", "prev(e): e one step ago";
        Delta = "delta", "delta(e): e less prev(e)";
        Potential = "potential", "potential(e, gamma: g): g times e less e a step ago, e being 0 once the episode terminates: shaping that changes no best policy";
        Held = "held", "held(c, for: d): c held in every step of the last d";
        Ever = "ever", "ever(c): c held at some step of the episode";
        Always = "always", "always(c): c held at every step of the episode";
        Since = "since", "since(E): the time since the last E, infinite before the first";
        Until = "until", "until(c, d): c held at every step until d first did";
        Within = "within", "within(c, d): c held at some step of the last d";
        Uniform = "uniform", "uniform(low, high) or uniform(region): drawn at reset";
        Normal = "normal", "normal(mean, sd): drawn at reset";
        TruncatedNormal = "truncated_normal", "truncated_normal(mean, sd, low, high): drawn at reset";
        Choice = "choice", "choice(a, b, …) or choice(a: weight, …): drawn at reset";
        Shuffle = "shuffle", "let (a, b) = shuffle(x, y): the same values in an order drawn at reset";
        Integer = "integer", "integer(low, high): a whole number drawn at reset, both ends included";
        Alternate = "alternate", "alternate(a, b): a in even episodes, b in odd ones";
        Rect = "rect", "rect(from, to): a rectangle";
        Circle = "circle", "circle(centre, radius): a disc";
        Polygon = "polygon", "polygon(a, b, c, …): between corners, in order";
        Sector = "sector", "sector(at, radius, from, to): the slice of a disc between two angles";
        Grid = "grid", "sum(E for p in grid(columns, rows, region)): the centres of the cells of a grid, over the pitch without a region";
        MinGap = "min_gap", "min_gap(team) or min_gap(players): the least distance between two of them at the start";
    }
}
