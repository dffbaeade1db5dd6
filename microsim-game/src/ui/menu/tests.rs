//! Menus under keys, mouse and wheel.

use super::*;

const LAYOUT: MenuLayout =
    MenuLayout { corner: Vec2::new(100.0, 50.0), item: Vec2::new(200.0, 20.0), visible: 3, size: TextSize::Body };

fn menu() -> Menu {
    let mut items = ["a", "b", "c", "d", "e"].map(MenuItem::new);
    items[1].value = Some("1".to_owned());
    Menu::new(items.into())
}

fn step(step: Move) -> Input {
    Input { step: Some(step), ..Input::default() }
}

fn click(x: f32, y: f32) -> Input {
    Input { cursor: Vec2::new(x, y), is_clicked: true, ..Input::default() }
}

#[test]
fn the_keyboard_goes_round_and_the_view_follows() {
    let mut menu = menu();
    menu.update(&step(Move::Up), &LAYOUT);
    assert_eq!((menu.focus, menu.first), (4, 2));
    assert_eq!(menu.update(&step(Move::Confirm), &LAYOUT), Some(MenuChoice::Pick(4)));
    menu.update(&step(Move::Down), &LAYOUT);
    assert_eq!((menu.focus, menu.first), (0, 0));
    assert_eq!(menu.update(&step(Move::Left), &LAYOUT), None, "it has no value");
    menu.update(&step(Move::Down), &LAYOUT);
    assert_eq!(menu.update(&step(Move::Left), &LAYOUT), Some(MenuChoice::Less(1)));
    assert_eq!(menu.update(&step(Move::Right), &LAYOUT), Some(MenuChoice::Pick(1)));
}

#[test]
fn home_and_end_lead_to_the_first_and_the_last_item_that_can_be_chosen() {
    let mut menu = menu();
    menu.items[0] = MenuItem::heading("about");
    menu.update(&step(Move::Last), &LAYOUT);
    assert_eq!((menu.focus, menu.first), (4, 2));
    menu.update(&step(Move::First), &LAYOUT);
    assert_eq!((menu.focus, menu.first), (1, 1));
}

#[test]
fn headings_are_passed_by_keys_wheel_and_mouse() {
    let mut menu = menu();
    for heading in [0, 3] {
        menu.items[heading] = MenuItem::heading("about");
    }
    let layout = MenuLayout { visible: 5, ..LAYOUT };
    let mut focus_after = |input: Input| {
        assert_eq!(menu.update(&input, &layout), None);
        menu.focus
    };
    assert_eq!([Move::Confirm, Move::Down, Move::Down, Move::Down].map(|to| focus_after(step(to))), [0, 1, 2, 4]);
    assert_eq!([Move::Down, Move::Up, Move::Up].map(|to| focus_after(step(to))), [1, 4, 2]);
    let wheel = |wheel| Input { wheel, cursor: Vec2::new(150.0, 75.0), ..Input::default() };
    assert_eq!([-1.0, -1.0, 1.0, 1.0, 1.0, 0.5].map(|by| focus_after(wheel(by))), [4, 4, 2, 1, 1, 1]);
    assert_eq!(focus_after(click(150.0, 115.0)), 1, "a heading");
}

#[test]
fn a_first_item_that_is_kept_is_seen_and_clicked_at_wherever_the_focus_is() {
    let mut menu = Menu { keeps_first: true, ..menu() };
    for focus in [4, 2, 1, 3, 0, 4] {
        menu.set_focus(focus);
        menu.update(&Input::default(), &LAYOUT);
        let seen: Vec<usize> = menu.shown(&LAYOUT).map(|(item, _)| item).collect();
        assert!(seen[0] == 0 && seen.contains(&focus) && seen.len() == 3, "{seen:?} with {focus}");
    }
    assert_eq!(menu.update(&click(150.0, 75.0), &LAYOUT), Some(MenuChoice::Pick(3)));
    assert_eq!(menu.update(&click(150.0, 55.0), &LAYOUT), Some(MenuChoice::Pick(0)));
}

#[test]
fn what_is_read_aloud_can_be_pointed_at_and_chosen() {
    let mut menu = menu();
    menu.items[2] = MenuItem::rated("c", 3);
    assert_eq!(menu.lines(), "0\na\nb: 1\nc, 3 stars\nd\ne");
    assert_eq!(menu.update(&Input { item: Some(4), ..Input::default() }, &LAYOUT), None);
    assert_eq!((menu.focus, menu.first), (4, 2));
    let chosen = Input { item: Some(1), ..step(Move::Confirm) };
    assert_eq!(menu.update(&chosen, &LAYOUT), Some(MenuChoice::Pick(1)));
    assert_eq!(menu.update(&Input { item: Some(9), ..step(Move::Confirm) }, &LAYOUT), Some(MenuChoice::Pick(4)));
}

#[test]
fn that_there_is_more_is_marked_beside_the_menu() {
    let (mut pen, _) = Pen::measured(Vec2::new(640.0, 360.0), 1.5);
    let layout = MenuLayout { visible: 3, ..MenuLayout::middle(&pen, 0.3) };
    let mut menu = menu();
    menu.update(&step(Move::Up), &layout);
    menu.draw(&mut pen, &layout);
    let end = layout.corner + Vec2::new(layout.item.x, 3.0 * layout.item.y);
    let corners: Vec<Vec2> = pen.canvas().corners().map(|(at, ..)| at).collect();
    assert!(corners.iter().all(|at| (layout.corner.y - 0.01..=end.y).contains(&at.y)), "{corners:?}");
    assert!(corners.iter().any(|at| at.x > end.x), "{corners:?}");
}

#[test]
fn the_mouse_picks_what_is_under_it() {
    let mut menu = menu();
    let mut clicked = |x, y| menu.update(&click(x, y), &LAYOUT);
    assert_eq!(clicked(150.0, 95.0), Some(MenuChoice::Pick(2)));
    assert_eq!(clicked(150.0, 75.0), Some(MenuChoice::Pick(1)));
    assert_eq!(clicked(210.0, 75.0), Some(MenuChoice::Less(1)));
    assert_eq!(clicked(290.0, 75.0), Some(MenuChoice::Pick(1)));
    for (x, y) in [(99.0, 75.0), (301.0, 75.0), (150.0, 49.0), (150.0, 111.0)] {
        assert_eq!(clicked(x, y), None);
    }
    assert_eq!(clicked(100.0 + BACK * 200.0, 75.0), Some(MenuChoice::Less(1)), "where the arrow is");
    assert!(Menu::default().update(&click(150.0, 75.0), &LAYOUT).is_none());
}
