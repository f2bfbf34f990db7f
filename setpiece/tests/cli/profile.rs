//! `setpiece profile`: what an agent does, as a page.

use super::{fails, folder, json, setpiece, text};

/// Writes a page; what the command prints, and the page.
fn profiled(agent: &str, scenario: &str, episodes: &str) -> (String, String) {
    let folder = folder();
    let path = folder.path().join("report.html");
    let path = path.to_string_lossy();
    let output = setpiece(&["profile", agent, scenario, "-o", &path, "-n", episodes, "-s", "3"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    (text(&output.stdout), std::fs::read_to_string(&*path).unwrap())
}

/// The number before a word.
fn count(line: &str, word: &str) -> usize {
    let words: Vec<&str> = line.split([' ', ',']).collect();
    let at = words.iter().position(|it| *it == word).unwrap();
    words[at - 1].parse().unwrap()
}

#[test]
fn the_page_shows_every_pass_and_shot_and_how_episodes_end() {
    let drill = "academy_3_vs_1_with_keeper";
    let (line, page) = profiled("bot", drill, "40");
    assert!(page.contains(&format!("<h1>bot in {drill}</h1>")), "{page}");
    let (shots, passes) = (count(&line, "shots"), count(&line, "passes"));
    assert!(shots > 20 && passes > 20, "{line}");
    // Those of the pitches have no opacity.
    assert_eq!(page.matches("fill-opacity=\"0.7\"").count(), shots);
    assert_eq!(page.matches("<line x1=").count(), passes);
    let run = json(&["run", drill, "-n", "40", "-s", "3", "--format", "json"]);
    let share = 100.0 * run["success_rate"].as_f64().unwrap();
    assert!(page.contains(&format!("<td>scored (success)</td><td class=\"number\">{share:.1} %")));
    let paid = run["terms"]["scoring/goal"].as_f64().unwrap();
    assert!(page.contains(&format!("<td>scoring/goal</td><td class=\"number\">{paid:+.3}</td>")));
    // An own goal isn't anybody's shot.
    let (goals, scored) = (
        page.matches("<title>goal</title>").count(),
        40.0 * run["score"]["left"].as_f64().unwrap(),
    );
    assert!(goals > 0 && (scored - 2.0..=scored).contains(&(goals as f64)), "{goals} of {scored}");
}

/// The bot scores with the others; the agent stands elsewhere and does nothing.
#[test]
fn what_teammates_do_is_not_the_agents() {
    let folder = folder();
    let drill = "scenario mine {
        ball at (40m, 0m)
        team left { GK at (-50m, 0m) far: CB at (-30m, 20m) CF at (39m, 0m) CM at (35m, 5m) }
        team right { GK at (50m, 0m) }
        agents { left: [far] }
        end success scored when goal by left
        end limit 10s
    }";
    let drill = super::write(folder.path(), "mine.pitch", drill);
    let (line, page) = profiled("idle", &drill, "10");
    assert!(page.contains("<td>scored (success)</td>"), "{page}");
    assert_eq!(["touches", "passes", "shots"].map(|word| count(&line, word)), [0; 3], "{line}");
    assert!(page.contains("players that the agent controls"), "{page}");
    let own = drill.replace("mine", "own");
    let text = std::fs::read_to_string(&drill).unwrap().replace("[far]", "all");
    std::fs::write(&own, text).unwrap();
    let (line, _) = profiled("bot", &own, "10");
    assert!(count(&line, "shots") >= 5 && count(&line, "touches") > 10, "{line}");
}

#[test]
fn the_page_needs_nothing_else_and_is_the_same_again() {
    let (line, page) = profiled("baseline", "academy_empty_goal_close", "5");
    let names = page.matches("http").count();
    assert_eq!(names, page.matches("xmlns=\"http://www.w3.org/2000/svg\"").count(), "{page}");
    for word in ["<script", "src=", "@import", "href="] {
        assert!(!page.contains(word), "{word}");
    }
    assert_eq!((line, page).1, profiled("baseline", "academy_empty_goal_close", "5").1);
}

#[test]
fn what_is_shown_attacks_to_the_right() {
    let folder = folder();
    let drill = "scenario mine {
        ball at (-40m, 0m)
        team left { GK at (-50m, 0m) }
        team right { CF at (-39m, 0m) }
        agents { right: 1 }
        end success scored when goal by right
        end limit 10s
    }";
    let drill = super::write(folder.path(), "mine.pitch", drill);
    let (line, page) = profiled("run_and_shoot", &drill, "10");
    assert!(count(&line, "shots") > 0, "{line}");
    let shots: Vec<&str> =
        page.split("<h2>Shots</h2>").nth(1).unwrap().split("<circle cx=\"").collect();
    // The shots come after the spots of the pitch.
    let places = shots.iter().skip(1).filter(|it| it.contains("fill-opacity"));
    let places: Vec<f64> =
        places.map(|it| it.split('"').next().unwrap().parse().unwrap()).collect();
    assert!(!places.is_empty() && places.iter().all(|x| *x > 30.0), "{places:?}");
}

#[test]
fn threads_change_nothing_and_parameters_do() {
    let folder = folder();
    let path = folder.path().join("report.html").to_string_lossy().into_owned();
    let page = |others: &[&str]| {
        let args = ["profile", "bot", "academy_3_vs_1_with_keeper", "-o", &path, "-n", "6"];
        let output = setpiece(&[&args[..], others].concat());
        assert!(output.status.success(), "{}", text(&output.stderr));
        std::fs::read_to_string(&path).unwrap()
    };
    let usual = page(&["-t", "1"]);
    assert_eq!(usual, page(&["-t", "3"]));
    assert_ne!(usual, page(&["--set", "difficulty=0.0"]));
    assert_eq!(page(&["--set", "difficulty=0.6"]), usual);
    let level = ["profile", "bot", "-o", &path, "--level", "academy_corner#3:2"];
    assert!(text(&setpiece(&level).stdout).contains("bot in academy_corner: 1 episodes"));
}

#[test]
fn a_suite_is_a_page_with_its_entries() {
    let folder = folder();
    let file = "scenario other extends academy_empty_goal { end limit 5s }
    suite some {
        academy_empty_goal_close for 3 episodes
        academy_3_vs_1_with_keeper(difficulty: 0.2) for 2 episodes seed 4
    }";
    let file = super::write(folder.path(), "some.pitch", file);
    let path = folder.path().join("report.html").to_string_lossy().into_owned();
    // As by `run`, the scenario of a file is played unless the suite is named.
    let output = setpiece(&["profile", "bot", &file, "-o", &path, "-n", "2"]);
    assert!(text(&output.stdout).contains("bot in other: 2 episodes"), "{output:?}");
    let args = ["profile", "bot", &file, "--scenario", "some", "-o", &path];
    let output = setpiece(&args);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let page = std::fs::read_to_string(&path).unwrap();
    for words in [
        "<h1>bot in some</h1>",
        "<h2>academy_empty_goal_close</h2>",
        "<h2>academy_3_vs_1_with_keeper{difficulty=0.2}</h2>",
        "3 episodes of the seed 0",
        "2 episodes of the seed 4",
    ] {
        assert!(page.contains(words), "{words}");
    }
    for option in [&["-n", "3"][..], &["--seed", "3"], &["--set", "difficulty=0.1"]] {
        fails(&[&args[..], option].concat(), 1, &["SP0020", "has no effect on a suite"]);
    }
    let words = ["6 of 11 entries have no baseline"];
    fails(&["profile", "baseline", "academy", "-o", &path], 1, &words);
}

/// Touches, passes and shots are drawn on one side of the pitch, in the figures too.
#[test]
fn what_is_shown_lies_on_one_side() {
    let folder = folder();
    let drill = "scenario mine {
        ball at (35m, 20m)
        team left { GK at (-50m, 0m) CF at (34m, 20m) }
        team right { GK at (50m, 0m) }
        agents { left: 1 }
        end success scored when goal by left
        end limit 1s
    }";
    let drill = super::write(folder.path(), "mine.pitch", drill);
    let path = folder.path().join("figures.json").to_string_lossy().into_owned();
    for (agent, what) in [("run_and_shoot", "touches"), ("shoots.onnx", "shots")] {
        let file = super::policy::shooting(folder.path());
        let agent = if agent == "shoots.onnx" { &file } else { agent };
        let output = setpiece(&["profile", agent, &drill, "-o", &path, "-n", "3"]);
        assert!(output.status.success(), "{}", text(&output.stderr));
        let figures: serde_json::Value =
            serde_json::from_slice(&std::fs::read(&path).unwrap()).unwrap();
        let found = figures[what].as_array().unwrap();
        assert!(!found.is_empty(), "{what}: {figures}");
        for one in found {
            let y = one.get("at").unwrap_or(one)[1].as_f64().unwrap();
            assert!(y > 10.0, "{what}: {one}");
        }
    }
}

#[test]
fn a_page_has_the_suffix_of_one() {
    fails(&["profile", "bot", "academy_corner", "-o", "report.pdf"], 1, &["SP0011", "report.html"]);
}
