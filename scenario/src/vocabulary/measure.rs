//! What checks and curricula measure.

use super::words;

words! {
    /// A measure of episodes; its documentation begins with its signature.
    MeasureWord {
        SuccessRate = "success_rate", "success_rate: the share of episodes that end with success";
        Rate = "rate", "rate(outcome NAME): the share of episodes with this outcome";
        Mean = "mean", "mean(Q): the average of a number that every episode has";
        Min = "min", "min(Q): the least of a number that every episode has";
        Max = "max", "max(Q): the greatest of a number that every episode has";
        Quantile = "quantile", "quantile(Q, 90%): the value that this share of the episodes doesn't exceed";
        Steps = "steps", "steps: how many steps a stage of a curriculum was played";
        Episodes = "episodes", "episodes: how many episodes a stage of a curriculum was played";
    }
}

words! {
    /// A number that every episode has.
    QuantityWord {
        Length = "length", "the episode's length in steps";
        Return = "return", "what all rewards paid";
        Score = "score", "goals of the left team less those of the right";
        Record = "record", "record NAME: what this record measured";
        Term = "term", "term \"NAME\": what this term of a reward paid";
    }
}
