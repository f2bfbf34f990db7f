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
fn a_page_has_the_suffix_of_one() {
    fails(&["profile", "bot", "academy_corner", "-o", "report.pdf"], 1, &["SP0011", "report.html"]);
}
